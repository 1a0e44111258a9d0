#include "licht/on_device/gpu_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <tuple>

#include "licht/colour/transfer.h"
#include "licht/core/error.h"
#include "licht/gpu/upload_image.h"
#include "licht/light/environment_table.h"
#include "licht/light/light_table.h"
#include "licht/on_device/flat_geometry.h"
#include "licht/shared/constants.h"
#include "licht/shared/effects.h"
#include "licht/shared/geometry.h"
#include "licht/shared/light.h"
#include "licht/shared/material.h"

namespace licht {
namespace {

uint wrapBits(Wrap wrap) {
    return static_cast<uint>(wrap);
}

TextureSlotRecord slotRecord(const TextureSlot& slot, bool srgb) {
    TextureSlotRecord record{};
    record.u_from_uv = slot.u_from_uv;
    record.v_from_uv = slot.v_from_uv;
    record.texture = slot.present() ? slot.texture : kNoIndex;
    record.flags = (slot.linear ? kSlotLinear : 0U) | wrapBits(slot.wrap_u) << kSlotWrapUShift |
                   wrapBits(slot.wrap_v) << kSlotWrapVShift | (srgb ? kSlotSrgb : 0U) |
                   slot.uv_set << kSlotUvSetShift;
    return record;
}

// KHR_materials_ior: reflectance of a dielectric against air at normal incidence; ior 0 stands for an
// infinite one.
float dielectricF0(float ior) {
    if (ior == 0.0F) return 1.0F;
    const float r = (ior - 1.0F) / (ior + 1.0F);
    return r * r;
}

MaterialRecord materialRecord(const Material& m) {
    MaterialRecord r{};
    r.base_color = m.base_color;
    r.emission = m.emission;
    r.metallic = m.metallic;
    r.roughness = m.roughness;
    r.specular = m.specular;
    r.specular_color = m.specular_color;
    r.dielectric_f0 = dielectricF0(m.ior);
    r.normal_scale = m.normal_scale;
    r.alpha_cutoff = m.alpha_cutoff;
    r.flags = (m.unlit ? kMaterialUnlit : 0U) | (m.alpha_mode == AlphaMode::mask ? kMaterialAlphaMask : 0U) |
              (m.alpha_mode == AlphaMode::blend ? kMaterialAlphaBlend : 0U) |
              (m.double_sided ? kMaterialDoubleSided : 0U);
    r.iridescence = m.iridescence;
    r.iridescence_ior = m.iridescence_ior;
    r.iridescence_thickness_minimum = m.iridescence_thickness_minimum;
    r.iridescence_thickness_maximum = m.iridescence_thickness_maximum;
    r.base_color_slot = slotRecord(m.base_color_texture, true);
    r.metallic_roughness_slot = slotRecord(m.metallic_roughness_texture, false);
    r.normal_slot = slotRecord(m.normal_texture, false);
    r.emissive_slot = slotRecord(m.emissive_texture, true);
    r.specular_slot = slotRecord(m.specular_texture, false);
    r.specular_color_slot = slotRecord(m.specular_color_texture, true);
    r.iridescence_slot = slotRecord(m.iridescence_texture, false);
    r.iridescence_thickness_slot = slotRecord(m.iridescence_thickness_texture, false);
    return r;
}

// Bits 1 << kSlot... of the slots that read a texture.
uint slotKinds(const MaterialRecord& r) {
    const auto bit = [](const TextureSlotRecord& slot, uint kind) {
        return slot.texture != kNoIndex ? 1U << kind : 0U;
    };
    return bit(r.base_color_slot, kSlotBaseColor) | bit(r.metallic_roughness_slot, kSlotMetallicRoughness) |
           bit(r.normal_slot, kSlotNormal) | bit(r.emissive_slot, kSlotEmissive) |
           bit(r.specular_slot, kSlotSpecular) | bit(r.specular_color_slot, kSlotSpecularColor) |
           bit(r.iridescence_slot, kSlotIridescence) |
           bit(r.iridescence_thickness_slot, kSlotIridescenceThickness);
}

InstanceTransformRecord transformRecord(const BvhInstance& placed) {
    const mat3 rows = glm::transpose(placed.world_from_object);
    return {rows[0],
            placed.pivot.x,
            rows[1],
            placed.pivot.y,
            rows[2],
            placed.pivot.z,
            placed.condition,
            placed.mirrored ? 1U : 0U,
            0,
            0};
}

constexpr VkBufferUsageFlags kFetched =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
static_assert(sizeof(MaterialRecord) == kMaterialTexels * sizeof(uvec4));

/// triangle: of the device's list.
TriangleName nameOf(const FlatGeometry& geometry, uint triangle) {
    if (triangle < geometry.triangle_instances.size()) {
        const uint instance = geometry.triangle_instances[triangle];
        return {triangle, instance, triangle - geometry.instances[instance].first_triangle};
    }
    const auto next =
        std::upper_bound(geometry.pieces.begin(), geometry.pieces.end(), triangle,
                         [](uint value, const MeshPiece& piece) { return value < piece.first_triangle; });
    return {triangle, 0, triangle - std::prev(next)->first_triangle};
}

}  // namespace

GpuScene::GpuScene(gpu::Device& device, const Scene& scene, const Effects& effects, const Options& options)
    : device_(&device),
      none_(device, "none", 256,
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
            gpu::Memory::device),
      sampler_(device, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_REPEAT,
               VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE) {
    const InstanceOrder order = orderInstances(scene, effects);
    std::vector<uint> first_light;
    uploadLights(scene, effects, order, options, first_light);
    const std::uint64_t before = bytes_;
    uploadGeometry(scene, effects, order, first_light, options);
    geometry_bytes_ = bytes_ - before;
    uploadMaterials(scene, effects);
    viewRecords(options.storage_buffers);
}

template <typename T>
gpu::Buffer GpuScene::upload(const char* name, const std::vector<T>& values, VkBufferUsageFlags usage) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    const std::uint64_t limit = device_->limits().maxStorageBufferRange;
    if (usage == VK_BUFFER_USAGE_STORAGE_BUFFER_BIT && bytes > limit)
        throw InputError(fmt::format(
            "the scene's {} take {} bytes, and this device's buffers hold at most {}", name, bytes, limit));
    bytes_ += bytes;
    return gpu::uploadBuffer(*device_, name, std::span<const T>(values), usage);
}

void GpuScene::uploadGeometry(const Scene& scene, const Effects& effects, const InstanceOrder& order,
                              const std::vector<uint>& first_light, const Options& options) {
    const FlatGeometry geometry = flattenGeometry(scene, effects, order, first_light);
    bounds_ = geometry.bounds;
    extra_uv_sets_ = geometry.extra_uv_sets;
    vertices_ = upload("vertices", geometry.vertices, kFetched);
    triangle_indices_ = upload("triangle_indices", geometry.indices, kFetched);
    instances_ = upload("instances", geometry.instances, kFetched);
    if (!geometry.tangents.empty()) tangents_ = upload("tangents", geometry.tangents);
    if (!geometry.colors.empty()) colors_ = upload("colors", geometry.colors);
    if (!geometry.extra_uvs.empty()) extra_uvs_ = upload("extra_uvs", geometry.extra_uvs);
    addDraws(geometry);
    uploadBvh(geometry, options);
}

// glTF: back faces of single-sided materials are not drawn. Rays meet both sides, so that visibility stays
// symmetric.
void GpuScene::addDraws(const FlatGeometry& geometry) {
    const auto cull = [](const InstanceRecord& record, VkCullModeFlags back) {
        return (record.flags & kInstanceDoubleSided) != 0 ? VkCullModeFlags{VK_CULL_MODE_NONE} : back;
    };
    const std::size_t baked = geometry.instances.size() - geometry.placements.size();
    for (std::size_t i = 0; i < baked; ++i) {
        const uint first = geometry.instances[i].first_triangle;
        const uint end = i + 1 < baked ? geometry.instances[i + 1].first_triangle
                                       : static_cast<uint>(geometry.triangle_instances.size());
        draws_.push_back({3 * first, 3 * (end - first), static_cast<uint>(i), 1,
                          cull(geometry.instances[i], VK_CULL_MODE_BACK_BIT)});
    }
    for (std::size_t k = 0; k < geometry.placements.size(); ++k) {
        const BvhInstance& placed = geometry.placements[k];
        if (k > 0 && placed.mesh == geometry.placements[k - 1].mesh &&
            placed.mirrored == geometry.placements[k - 1].mirrored) {
            ++draws_.back().instance_count;
            continue;
        }
        const MeshPiece& piece = geometry.pieces[placed.mesh];
        draws_.push_back({3 * piece.first_triangle, 3 * piece.triangle_count, static_cast<uint>(baked + k), 1,
                          cull(geometry.instances[baked + k],
                               placed.mirrored ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT)});
    }
}

void GpuScene::uploadBvh(const FlatGeometry& geometry, const Options& options) {
    std::vector<std::vector<BvhTriangle>> meshes;
    std::vector<uint> triangle_counts{static_cast<uint>(geometry.triangle_instances.size())};
    for (const MeshPiece& piece : geometry.pieces) {
        meshes.push_back(piece.triangles);
        triangle_counts.push_back(piece.triangle_count);
    }
    TwoLevelBvh tree =
        buildTwoLevelBvh(worldTriangles(geometry), meshes, geometry.placements, {options.bvh_quality});
    bvh_seconds_ = tree.build_seconds;
    bvh_dropped_ = tree.baked.dropped;
    for (const Bvh& mesh : tree.meshes) bvh_dropped_ += mesh.dropped;
    bounds_.extend(tree.top_bounds);
    const JoinedBvh bvh = joinLevels(tree, triangle_counts);
    if (!geometry.placements.empty()) {
        baked_instances_ = static_cast<uint>(geometry.instances.size() - geometry.placements.size());
        first_instance_position_ = bvh.first_instance_position;
        instance_slack_ = tree.slack;
        std::vector<InstanceTransformRecord> records;
        for (const BvhInstance& placed : geometry.placements) records.push_back(transformRecord(placed));
        instance_transforms_ = upload("instance_transforms", records);
    }
    std::vector<vec4> texels;
    texels.reserve(std::size_t{kBvhTexelsPerTriangle} * bvh.ids.size());
    for (std::size_t i = 0; i < bvh.ids.size(); ++i) {
        const uint id = bvh.ids[i];
        if (i >= bvh.first_instance_position) {
            appendInstanceTexels(texels, geometry.placements[id]);
            continue;
        }
        const auto corner = [&](std::size_t k) {
            return geometry.vertices[geometry.indices[std::size_t{3} * id + k]].position;
        };
        appendTriangleTexels(texels, BvhTriangle{corner(0), corner(1), corner(2)}, nameOf(geometry, id));
    }
    if (!geometry.placements.empty()) {
        first_instance_texel_ = static_cast<uint>(texels.size()) - bvh.first_instance_position;
        for (std::size_t i = bvh.first_instance_position; i < bvh.ids.size(); ++i)
            texels.emplace_back(bvh.roots[geometry.placements[bvh.ids[i]].mesh], bvh.ids[i], 0.0F, 0.0F);
    }
    bvh_ = GpuBvh(*device_, bvh.nodes, texels, bvh.max_stack, options.storage_buffers);
    bytes_ += bvh_.bytes();
}

// See shaders/bound/scene_data.glsl.
void GpuScene::viewRecords(bool storage) {
    const std::array<std::tuple<const char*, const gpu::Buffer*, VkFormat>, 7> records{
        {{"vertex_texels", &vertices_, VK_FORMAT_R32G32B32A32_UINT},
         {"triangle_index_texels", &triangle_indices_, VK_FORMAT_R32_UINT},
         {"instance_texels", &instances_, VK_FORMAT_R32G32B32A32_UINT},
         {"material_texels", &materials_, VK_FORMAT_R32G32B32A32_UINT},
         {"light_texels", &lights_, VK_FORMAT_R32G32B32A32_UINT},
         {"light_alias_texels", &light_alias_, VK_FORMAT_R32G32B32A32_UINT},
         {"light_tree_texels", &light_tree_, VK_FORMAT_R32G32B32A32_UINT}}};
    records_in_storage_ =
        storage || std::any_of(records.begin(), records.end(), [this](const auto& record) {
            const auto& [name, buffer, format] = record;
            return buffer->size() / gpu::texelBytes(format) > device_->limits().maxTexelBufferElements;
        });
    record_views_.reserve(records.size());
    for (const auto& [name, buffer, format] : records) {
        if (records_in_storage_ && buffer->size() > device_->limits().maxStorageBufferRange)
            throw InputError(fmt::format(
                "the scene's {} take {} bytes, and this device's buffers hold at most {} texels or {} bytes",
                buffer->name(), buffer->size(), device_->limits().maxTexelBufferElements,
                device_->limits().maxStorageBufferRange));
        const gpu::Buffer& viewed = *buffer && !records_in_storage_ ? *buffer : none_;
        record_views_.push_back({name, gpu::TexelView(*device_, viewed, format)});
    }
}

void GpuScene::uploadMaterials(const Scene& scene, const Effects& effects) {
    std::vector<MaterialRecord> records;
    for (const Material& m : scene.materials) records.push_back(materialRecord(m));
    for (const MaterialRecord& r : records) slot_kinds_ |= slotKinds(r);
    materials_ = upload("materials", records, kFetched);
    if (effects.has(kEffectTextures)) uploadTexels(scene);
}

// Textures go to pages in order, first fit; one texture lies in one page.
void GpuScene::uploadTexels(const Scene& scene) {
    constexpr std::size_t kPageWords = std::size_t{1} << kTexelsPerPageLog2;
    std::vector<std::vector<uint>> pages(1);
    std::vector<TextureRecord> records;
    for (const Texture& t : scene.textures) {
        const std::size_t words = t.bytes.size() / 4;
        if (words > kPageWords)
            throw InputError(fmt::format("texture '{}' has {} words, and a page holds at most {}", t.name,
                                         words, kPageWords));
        std::size_t page = 0;
        while (page < pages.size() && pages[page].size() + words > kPageWords) ++page;
        if (page == kTexturePages)
            throw InputError(
                fmt::format("texture '{}': the scene's textures take more than {} pages of {} words", t.name,
                            kTexturePages, kPageWords));
        if (page == pages.size()) pages.emplace_back();
        TextureRecord record{};
        record.page = static_cast<uint>(page);
        record.first_word = static_cast<uint>(pages[page].size());
        record.width = t.width;
        record.height = t.height;
        record.words_per_texel = t.bits == 16 ? 2 : 1;
        wide_texels_ = wide_texels_ || t.bits == 16;
        records.push_back(record);
        for (std::size_t i = 0; i < words; ++i) {
            const std::uint8_t* b = &t.bytes[4 * i];
            pages[page].push_back(uint{b[0]} | uint{b[1]} << 8U | uint{b[2]} << 16U | uint{b[3]} << 24U);
        }
    }
    for (const std::vector<uint>& page : pages) texel_pages_.push_back(upload("texels", page));
    textures_ = upload("textures", records);
    std::vector<float> table;
    for (int i = 0; i < 256; ++i) table.push_back(linearFromSrgb(static_cast<float>(i) / 255.0F));
    srgb_table_ = upload("srgb_table", table);
}

void GpuScene::uploadLights(const Scene& scene, const Effects& effects, const InstanceOrder& order,
                            const Options& options, std::vector<uint>& first_light) {
    const bool present = effects.has(kEffectEnvironment) && scene.environment;
    const EnvironmentTable drawn =
        present ? buildEnvironmentTable(options.direct == DirectLight::area
                                            ? environmentShares(*scene.environment)
                                            : sharesAboveMean(*scene.environment),
                                        scene.environment->radiance.width, options.environment_sampling)
                : EnvironmentTable{};
    const bool samples_lights = options.direct != DirectLight::hemisphere;
    LightTable table = buildLightTable(
        scene, effects, {.surfaces_and_suns = samples_lights, .sky = samples_lights && drawn.peak > 0.0F},
        options.lights);
    for (LightRecord& light : table.lights)
        if (isShape(light)) light.instance = order.device_instance[light.instance];
    first_light = std::move(table.first_light);
    light_slots_ = static_cast<uint>(table.alias.size());
    tree_lights_ = table.tree_lights;
    lights_by_ = tree_lights_ > 0 ? LightChoice::tree : LightChoice::power;
    if (!table.tree.empty()) light_tree_ = upload("light_tree", table.tree, kFetched);
    first_sun_ = table.first_sun;
    suns_ = table.suns;
    if (!table.lights.empty()) lights_ = upload("lights", table.lights, kFetched);
    if (light_slots_ > 0) light_alias_ = upload("light_alias", table.alias, kFetched);
    environment_light_ = table.environment_light;
    has_sky_ = scene.environment ? 1U : 0U;
    const Image black(1, 1, 3);
    const Image& map = present ? scene.environment->radiance : black;
    const uint limit = device_->limits().maxImageDimension2D;
    if (std::max({static_cast<uint>(map.width), static_cast<uint>(map.height), drawn.size.x}) > limit)
        throw InputError(
            fmt::format("environment '{}' has {}x{} texels, and this device's images at most {} a side",
                        scene.environment->name, map.width, map.height, limit));
    environment_size_ = uvec2(map.width, map.height);
    std::vector<vec4> texels;
    texels.reserve(map.texels.size() / 3);
    for (std::size_t i = 0; i + 2 < map.texels.size(); i += 3)
        texels.emplace_back(map.texels[i], map.texels[i + 1], map.texels[i + 2], 0.0F);
    environment_map_ = gpu::uploadImage(
        *device_, "environment_map", {environment_size_.x, environment_size_.y},
        VK_FORMAT_R32G32B32A32_SFLOAT, std::as_bytes(std::span(texels)), VK_IMAGE_USAGE_SAMPLED_BIT);
    environment_peak_ = drawn.peak;
    environment_sampling_ = options.environment_sampling;
    environment_table_ = gpu::uploadImage(*device_, "environment_table", {drawn.size.x, drawn.size.y},
                                          drawn.words == 4 ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_R32_UINT,
                                          std::as_bytes(std::span(drawn.texels)), VK_IMAGE_USAGE_SAMPLED_BIT);
}

std::vector<gpu::BoundResource> GpuScene::resources() const {
    const auto orNone = [this](const gpu::Buffer& b) { return b ? &b : &none_; };
    const auto inStorage = [this](const gpu::Buffer& b) { return b && records_in_storage_ ? &b : &none_; };
    std::vector<gpu::BoundResource> list{
        {"Vertices", inStorage(vertices_)},
        {"TriangleIndices", inStorage(triangle_indices_)},
        {"Instances", inStorage(instances_)},
        {"Materials", inStorage(materials_)},
        {"Tangents", orNone(tangents_)},
        {"Colors", orNone(colors_)},
        {"ExtraUvs", orNone(extra_uvs_)},
        {"Textures", orNone(textures_)},
        {"SrgbTable", orNone(srgb_table_)},
        {"InstanceTransforms", orNone(instance_transforms_)},
        {"Lights", inStorage(lights_)},
        {"LightAlias", inStorage(light_alias_)},
        {"LightTree", inStorage(light_tree_)},
        {"environment_table", gpu::SampledImage{&environment_table_, &sampler_}},
        {"environment_map", gpu::SampledImage{&environment_map_, &sampler_}},
    };
    bvh_.addTo(list);
    for (const RecordView& record : record_views_) list.push_back({record.name, &record.view});
    for (const gpu::Buffer& page : texel_pages_) list.push_back({"texel_pages", &page});
    if (texel_pages_.empty()) list.push_back({"texel_pages", &none_});
    return list;
}

void GpuScene::describe(FrameRecord& frame) const {
    frame.light_slots = light_slots_;
    frame.tree_lights = tree_lights_;
    frame.environment_light = environment_light_;
    frame.first_sun = first_sun_;
    frame.suns = suns_;
    frame.environment_size = environment_size_;
    frame.environment_peak = environment_peak_;
    frame.extra_uv_sets = extra_uv_sets_;
    frame.has_sky = has_sky_;
}

gpu::SpecConstants GpuScene::constants() const {
    gpu::SpecConstants constants{{kConstantSceneInStorage, records_in_storage_ ? 1U : 0U},
                                 {kConstantLights, static_cast<uint>(lights_by_)},
                                 {kConstantEnvironmentSampling, static_cast<uint>(environment_sampling_)},
                                 {kConstantTexturePages, static_cast<uint>(texel_pages_.size())},
                                 {kConstantTextureSlotKinds, slot_kinds_},
                                 {kConstantWideTexels, wide_texels_ ? 1U : 0U},
                                 {kConstantBakedInstances, baked_instances_},
                                 {kConstantFirstInstancePosition, first_instance_position_},
                                 {kConstantInstanceSlack, std::bit_cast<uint>(instance_slack_)},
                                 {kConstantFirstInstanceTexel, first_instance_texel_}};
    bvh_.addTo(constants);
    return constants;
}

}  // namespace licht
