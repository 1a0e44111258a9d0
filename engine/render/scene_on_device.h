#pragma once
// A scene and, where it changes from frame to frame, the one before it, whose vertices tell where things
// were.
#include <memory>
#include <vector>

#include "licht/on_device/gpu_scene.h"

namespace licht {

enum class SceneChange {
    motion,  ///< the same surfaces, elsewhere or of other materials and lights
    other,   ///< nothing that was seen of the one before is of use, and programs may be others
};

class SceneOnDevice {
public:
    /// `effects`: what is compiled. settings.scene_moves: whether it may be replaced. Throws as GpuScene
    /// does.
    SceneOnDevice(gpu::Device& device, const Scene& scene, const Effects& effects,
                  const RenderSettings& settings);

    /// Nothing may be in flight. `seen`: the present scene was drawn; otherwise the one before it stays that.
    /// Effects only grow, so that what is switched off need not be compiled out.
    SceneChange replace(const Scene& scene, bool seen);
    /// The scene before is this one, too. Nothing may be in flight.
    void rest() { before_.reset(); }

    [[nodiscard]] const GpuScene& now() const { return *now_; }
    [[nodiscard]] const GpuScene& before() const { return before_ ? *before_ : *now_; }
    [[nodiscard]] bool moved() const { return before_ != nullptr; }
    /// What programs are compiled for: this scene and, where it may be replaced, others like it.
    [[nodiscard]] const gpu::SpecConstants& constants() const { return compiled_; }
    [[nodiscard]] const Effects& effects() const { return effects_; }

private:
    [[nodiscard]] std::unique_ptr<GpuScene> bring(const Scene& scene) const;
    [[nodiscard]] gpu::SpecConstants constantsOf(const GpuScene& scene) const;
    gpu::Device& device_;
    const RenderSettings& settings_;
    Effects effects_;
    std::unique_ptr<GpuScene> now_, before_;
    gpu::SpecConstants compiled_;
    std::vector<std::size_t> surfaces_;  ///< counts by which scenes of the same surfaces are known
};

}  // namespace licht
