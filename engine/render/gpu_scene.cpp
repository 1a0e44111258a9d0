#include "licht/render/gpu_scene.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "licht/colour/transfer.h"
#include "licht/core/error.h"
#include "licht/gpu/upload_image.h"
#include "licht/render/flat_geometry.h"
#include "licht/render/light_table.h"

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

}  // namespace

GpuScene::GpuScene(gpu::Device& device, const Scene& scene, const Effects& effects, const Options& options)
    : device_(&device),
      none_(device, "none", 256,
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
            gpu::Memory::device),
      sampler_(device, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_REPEAT,
               VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE) {
    std::vector<uint> first_light;
    uploadLights(scene, effects, options.sample_surfaces_and_sky, first_light);
    uploadGeometry(scene, effects, first_light, options.storage_buffer_bvh);
    uploadMaterials(scene, effects);
}

template <typename T>
gpu::Buffer GpuScene::upload(const char* name, const std::vector<T>& values, VkBufferUsageFlags usage) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    const std::uint64_t limit = device_->limits().maxStorageBufferRange;
    if ((usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) != 0 && bytes > limit)
        throw InputError(fmt::format(
            "the scene's {} take {} bytes, and this device's buffers hold at most {}", name, bytes, limit));
    return gpu::uploadBuffer(*device_, name, std::span<const T>(values), usage);
}

void GpuScene::uploadGeometry(const Scene& scene, const Effects& effects,
                              const std::vector<uint>& first_light, bool storage_buffer_bvh) {
    const FlatGeometry geometry = flattenGeometry(scene, effects, first_light);
    bounds_ = geometry.bounds;
    extra_uv_sets_ = geometry.extra_uv_sets;
    vertices_ = upload("vertices", geometry.vertices);
    triangle_indices_ = upload("triangle_indices", geometry.indices);
    instances_ = upload("instances", geometry.instances);
    triangle_instances_ = upload("triangle_instances", geometry.triangle_instances);
    if (!geometry.tangents.empty()) tangents_ = upload("tangents", geometry.tangents);
    if (!geometry.colors.empty()) colors_ = upload("colors", geometry.colors);
    if (!geometry.extra_uvs.empty()) extra_uvs_ = upload("extra_uvs", geometry.extra_uvs);
    for (std::size_t i = 0; i < geometry.instances.size(); ++i) {
        const InstanceRecord& record = geometry.instances[i];
        const auto triangles = static_cast<uint>(scene.meshes[scene.instances[i].mesh].triangles.size());
        draws_.push_back(
            {3 * record.first_triangle, 3 * triangles, (record.flags & kInstanceDoubleSided) != 0});
    }
    uploadBvh(worldTriangles(geometry), storage_buffer_bvh);
}

void GpuScene::uploadBvh(const std::vector<BvhTriangle>& triangles, bool storage) {
    const Bvh bvh = buildBvh(triangles);
    bvh_seconds_ = bvh.build_seconds;
    bvh_dropped_ = bvh.dropped;
    stack_size_ = std::max(bvh.max_stack, 1U);
    std::vector<vec4> positions;
    positions.reserve(kBvhTexelsPerTriangle * bvh.triangle_ids.size());
    for (const uint id : bvh.triangle_ids)
        for (const vec3& v : {triangles[id].v0, triangles[id].v1, triangles[id].v2})
            positions.emplace_back(v, 0.0F);
    const std::size_t most_texels = std::max(kBvhTexelsPerNode * bvh.nodes.size(), positions.size());
    bvh_in_storage_ = storage || most_texels > device_->limits().maxTexelBufferElements;
    const VkBufferUsageFlags usage =
        bvh_in_storage_ ? VK_BUFFER_USAGE_STORAGE_BUFFER_BIT : VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    nodes_ = upload("bvh_nodes", bvh.nodes, usage);
    bvh_triangles_ = upload("bvh_triangles", positions, usage);
    triangle_ids_ = upload("bvh_triangle_ids", bvh.triangle_ids);
    const gpu::Buffer& nodes = bvh_in_storage_ ? none_ : nodes_;
    nodes_view_ = gpu::TexelView(*device_, nodes, VK_FORMAT_R32G32B32A32_SFLOAT);
    children_view_ = gpu::TexelView(*device_, nodes, VK_FORMAT_R32G32B32A32_UINT);
    triangles_view_ =
        gpu::TexelView(*device_, bvh_in_storage_ ? none_ : bvh_triangles_, VK_FORMAT_R32G32B32A32_SFLOAT);
}

void GpuScene::uploadMaterials(const Scene& scene, const Effects& effects) {
    std::vector<MaterialRecord> records;
    for (const Material& m : scene.materials) records.push_back(materialRecord(m));
    for (const MaterialRecord& r : records) slot_kinds_ |= slotKinds(r);
    materials_ = upload("materials", records);
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

void GpuScene::uploadLights(const Scene& scene, const Effects& effects, bool sample_surfaces_and_sky,
                            std::vector<uint>& first_light) {
    LightTable table = buildLightTable(scene, effects, sample_surfaces_and_sky);
    first_light = std::move(table.first_light);
    light_count_ = static_cast<uint>(table.lights.size());
    if (light_count_ > 0) {
        lights_ = upload("lights", table.lights);
        light_alias_ = upload("light_alias", table.alias);
    }
    environment_light_ = table.environment_light;
    const bool present = effects.has(kEffectEnvironment) && scene.environment;
    has_sky_ = scene.environment ? 1U : 0U;
    const Image black(1, 1, 3);
    const Image& map = present ? scene.environment->radiance : black;
    const auto limit = static_cast<int>(device_->limits().maxImageDimension2D);
    if (map.width > limit || map.height > limit)
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
    if (!present) return;
    std::vector<AliasRecord> alias = buildEnvironmentTable(*scene.environment);
    // Black maps have no table; the effect is off for them, unless everything is compiled in.
    if (alias.empty()) alias.resize(texels.size());
    environment_alias_ = upload("environment_alias", alias);
}

std::vector<gpu::BoundResource> GpuScene::resources() const {
    const auto orNone = [this](const gpu::Buffer& b) { return b ? &b : &none_; };
    const gpu::Buffer* nodes = bvh_in_storage_ ? &nodes_ : &none_;
    std::vector<gpu::BoundResource> list{
        {"Vertices", &vertices_},
        {"TriangleIndices", &triangle_indices_},
        {"Instances", &instances_},
        {"Materials", &materials_},
        {"TriangleInstances", &triangle_instances_},
        {"Tangents", orNone(tangents_)},
        {"Colors", orNone(colors_)},
        {"ExtraUvs", orNone(extra_uvs_)},
        {"Textures", orNone(textures_)},
        {"SrgbTable", orNone(srgb_table_)},
        {"Lights", orNone(lights_)},
        {"LightAlias", orNone(light_alias_)},
        {"EnvironmentAlias", orNone(environment_alias_)},
        {"environment_map", gpu::SampledImage{&environment_map_, &sampler_}},
        {"bvh_nodes", &nodes_view_},
        {"bvh_children", &children_view_},
        {"bvh_triangles", &triangles_view_},
        {"bvh_nodes_storage", nodes},
        {"bvh_children_storage", nodes},
        {"bvh_triangles_storage", bvh_in_storage_ ? &bvh_triangles_ : &none_},
        {"bvh_triangle_ids", &triangle_ids_},
    };
    for (const gpu::Buffer& page : texel_pages_) list.push_back({"texel_pages", &page});
    if (texel_pages_.empty()) list.push_back({"texel_pages", &none_});
    return list;
}

void GpuScene::describe(FrameRecord& frame) const {
    frame.light_count = light_count_;
    frame.environment_light = environment_light_;
    frame.environment_size = environment_size_;
    frame.extra_uv_sets = extra_uv_sets_;
    frame.has_sky = has_sky_;
}

gpu::SpecConstants GpuScene::constants() const {
    return {{kConstantBvhInStorage, bvh_in_storage_ ? 1U : 0U},
            {kConstantBvhStackSize, stack_size_},
            {kConstantTexturePages, static_cast<uint>(texel_pages_.size())},
            {kConstantTextureSlotKinds, slot_kinds_},
            {kConstantWideTexels, wide_texels_ ? 1U : 0U}};
}

}  // namespace licht
