#include "licht/on_device/gpu_lights.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/gpu/upload_image.h"
#include "licht/light/environment_table.h"
#include "licht/light/light_table.h"
#include "licht/shared/constants.h"
#include "licht/shared/effects.h"
#include "licht/shared/light.h"

namespace licht {

GpuLights::GpuLights(Uploads& uploads, const Scene& scene, const Effects& effects, const InstanceOrder& order,
                     const Options& options)
    : sampler_(uploads.device(), VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_REPEAT,
               VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE),
      environment_sampling_(options.environment_sampling),
      has_sky_(scene.environment ? 1U : 0U) {
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
        options.choice);
    for (LightRecord& light : table.lights)
        if (isShape(light)) light.instance = order.device_instance[light.instance];
    uploadTable(uploads, table);
    const bool by_tree = tree_lights_ > 0 || (options.changes && options.choice == LightChoice::tree);
    lights_by_ = by_tree ? LightChoice::tree : LightChoice::power;
    uploadEnvironment(uploads, present ? &*scene.environment : nullptr, drawn);
    first_light_ = std::move(table.first_light);
}

void GpuLights::uploadTable(Uploads& uploads, const LightTable& table) {
    light_slots_ = static_cast<uint>(table.alias.size());
    tree_lights_ = table.tree_lights;
    first_sun_ = table.first_sun;
    suns_ = table.suns;
    environment_light_ = table.environment_light;
    light_tree_ = uploads.bufferIfAny("light_tree", table.tree, kFetchedUsage);
    lights_ = uploads.bufferIfAny("lights", table.lights, kFetchedUsage);
    light_alias_ = uploads.bufferIfAny("light_alias", table.alias, kFetchedUsage);
}

// Without an environment: a black texel.
void GpuLights::uploadEnvironment(Uploads& uploads, const Environment* environment,
                                  const EnvironmentTable& drawn) {
    gpu::Device& device = uploads.device();
    const Image black(1, 1, 3);
    const Image& map = environment != nullptr ? environment->radiance : black;
    const uint limit = device.limits().maxImageDimension2D;
    if (std::max({static_cast<uint>(map.width), static_cast<uint>(map.height), drawn.size.x}) > limit)
        throw InputError(
            fmt::format("environment '{}' has {}x{} texels, and this device's images at most {} a side",
                        environment != nullptr ? environment->name : "none", map.width, map.height, limit));
    environment_size_ = uvec2(map.width, map.height);
    environment_peak_ = drawn.peak;
    environment_turn_ = environment != nullptr ? environment->turn : 0.0F;
    std::vector<vec4> texels;
    texels.reserve(map.texels.size() / 3);
    for (std::size_t i = 0; i + 2 < map.texels.size(); i += 3)
        texels.emplace_back(map.texels[i], map.texels[i + 1], map.texels[i + 2], 0.0F);
    environment_map_ = gpu::uploadImage(device, "environment_map", {environment_size_.x, environment_size_.y},
                                        VK_FORMAT_R32G32B32A32_SFLOAT, std::as_bytes(std::span(texels)),
                                        VK_IMAGE_USAGE_SAMPLED_BIT);
    environment_table_ = gpu::uploadImage(device, "environment_table", {drawn.size.x, drawn.size.y},
                                          drawn.words == 4 ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_R32_UINT,
                                          std::as_bytes(std::span(drawn.texels)), VK_IMAGE_USAGE_SAMPLED_BIT);
}

void GpuLights::addTo(std::vector<gpu::BoundResource>& resources) const {
    resources.push_back({"environment_table", gpu::SampledImage{&environment_table_, &sampler_}});
    resources.push_back({"environment_map", gpu::SampledImage{&environment_map_, &sampler_}});
}

void GpuLights::addTo(std::vector<FetchedRecords>& records) const {
    records.insert(records.end(), {{"Lights", "light_texels", &lights_},
                                   {"LightAlias", "light_alias_texels", &light_alias_},
                                   {"LightTree", "light_tree_texels", &light_tree_}});
}

void GpuLights::addTo(gpu::SpecConstants& constants) const {
    constants[kConstantLights] = static_cast<uint>(lights_by_);
    constants[kConstantEnvironmentSampling] = static_cast<uint>(environment_sampling_);
}

void GpuLights::describe(FrameRecord& frame) const {
    frame.light_slots = light_slots_;
    frame.tree_lights = tree_lights_;
    frame.environment_light = environment_light_;
    frame.first_sun = first_sun_;
    frame.suns = suns_;
    frame.environment_size = environment_size_;
    frame.environment_peak = environment_peak_;
    frame.environment_turn = environment_turn_;
    frame.has_sky = has_sky_;
}

}  // namespace licht
