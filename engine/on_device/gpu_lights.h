#pragma once
#include <vector>

#include "licht/gpu/program.h"
#include "licht/on_device/flat_geometry.h"
#include "licht/on_device/record_views.h"
#include "licht/on_device/uploads.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"
#include "licht/shared/frame.h"
#include "licht/shared/index.h"

namespace licht {

struct EnvironmentTable;
struct LightTable;

/// The lights on the device: their records, alias table and tree, and the environment.
class GpuLights {
public:
    struct Options {
        DirectLight direct;
        LightChoice choice;
        EnvironmentSampling environment_sampling;
        bool changes;  ///< a tree may come, so programs look for one
    };

    GpuLights() = default;
    /// Throws InputError, with the numbers, where the environment is larger than the device's images may be.
    GpuLights(Uploads& uploads, const Scene& scene, const Effects& effects, const InstanceOrder& order,
              const Options& options);

    void addTo(std::vector<gpu::BoundResource>& resources) const;
    void addTo(std::vector<FetchedRecords>& records) const;
    void addTo(gpu::SpecConstants& constants) const;
    void describe(FrameRecord& frame) const;
    /// Per instance of the scene: of its first triangle.
    [[nodiscard]] const std::vector<uint>& firstLights() const { return first_light_; }

private:
    void uploadTable(Uploads& uploads, const LightTable& table);
    void uploadEnvironment(Uploads& uploads, const Environment* environment, const EnvironmentTable& drawn);

    gpu::Buffer lights_, light_alias_, light_tree_;
    gpu::Image environment_map_, environment_table_;
    gpu::Sampler sampler_;
    std::vector<uint> first_light_;
    EnvironmentSampling environment_sampling_ = EnvironmentSampling::alias;
    LightChoice lights_by_ = LightChoice::power;
    uvec2 environment_size_{1, 1};
    float environment_peak_ = 0.0F;
    float environment_turn_ = 0.0F;
    uint light_slots_ = 0;
    uint tree_lights_ = 0;
    uint environment_light_ = kNoIndex;
    uint first_sun_ = 0;
    uint suns_ = 0;
    uint has_sky_ = 0;
};

}  // namespace licht
