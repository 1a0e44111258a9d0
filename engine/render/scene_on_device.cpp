#include "licht/render/scene_on_device.h"

#include "licht/render/preparation.h"
#include "licht/shared/constants.h"

namespace licht {
namespace {

/// Of each instance: its mesh, that mesh's size, and on which side its fronts are.
std::vector<std::size_t> surfacesOf(const Scene& scene) {
    std::vector<std::size_t> counts{scene.materials.size()};
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const bool mirrored = glm::determinant(mat3(instance.world_from_object)) < 0.0F;
        counts.insert(counts.end(),
                      {instance.mesh, mesh.positions.size(), mesh.triangles.size(), mirrored ? 1U : 0U});
    }
    return counts;
}

/// Whether programs compiled for one scene draw the other: a deeper stack than needed does no harm.
bool drawsToo(const gpu::SpecConstants& compiled, gpu::SpecConstants wanted) {
    const auto deep = compiled.find(kConstantBvhStackSize);
    const auto needed = wanted.find(kConstantBvhStackSize);
    if (deep != compiled.end() && needed != wanted.end() && needed->second < deep->second)
        needed->second = deep->second;
    return compiled == wanted;
}

}  // namespace

SceneOnDevice::SceneOnDevice(gpu::Device& device, const Scene& scene, const Effects& effects,
                             const RenderSettings& settings)
    : device_(device),
      settings_(settings),
      effects_(effects),
      now_(bring(scene)),
      compiled_(constantsOf(*now_)),
      surfaces_(surfacesOf(scene)) {}

std::unique_ptr<GpuScene> SceneOnDevice::bring(const Scene& scene) const {
    return std::make_unique<GpuScene>(
        device_, scene, effects_,
        GpuScene::Options{settings_.direct, settings_.storage_buffers, settings_.bvh_quality,
                          settings_.lights, settings_.environment_sampling, settings_.scene_moves});
}

// A tree whose boxes move becomes deeper or flatter.
gpu::SpecConstants SceneOnDevice::constantsOf(const GpuScene& scene) const {
    constexpr std::uint32_t kDeeper = 4;
    gpu::SpecConstants constants = scene.constants();
    if (settings_.scene_moves) constants[kConstantBvhStackSize] += kDeeper;
    return constants;
}

SceneChange SceneOnDevice::replace(const Scene& scene, bool seen) {
    const Effects wanted = effectsOf(scene, settings_);
    for (std::size_t effect = 0; effect < wanted.on.size(); ++effect) {
        if (!wanted.on[effect] || effects_.on[effect]) continue;
        effects_.on[effect] = true;
        effects_.evidence[effect] = wanted.evidence[effect];
    }
    std::unique_ptr<GpuScene> next = bring(scene);
    std::vector<std::size_t> surfaces = surfacesOf(scene);
    const bool same = surfaces == surfaces_ && drawsToo(compiled_, next->constants());
    if (!same)
        before_.reset();
    else if (seen || !before_)
        before_ = std::move(now_);
    now_ = std::move(next);
    surfaces_ = std::move(surfaces);
    if (!same) compiled_ = constantsOf(*now_);
    return same ? SceneChange::motion : SceneChange::other;
}

}  // namespace licht
