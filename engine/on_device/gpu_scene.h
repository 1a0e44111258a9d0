#pragma once
#include <vector>

#include "licht/gpu/program.h"
#include "licht/gpu/resource.h"
#include "licht/on_device/gpu_geometry.h"
#include "licht/on_device/gpu_levels.h"
#include "licht/on_device/gpu_lights.h"
#include "licht/on_device/gpu_materials.h"
#include "licht/on_device/gpu_textures.h"
#include "licht/on_device/record_views.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"
#include "licht/shared/frame.h"

namespace licht {

/// The scene on the device: triangles (in world space, or in an instanced mesh's own), materials, texels,
/// lights and the BVH. A buffer exists only where an effect calls for it; programs that name an absent one
/// are bound to a few zero bytes and, being specialised, never read them.
class GpuScene {
public:
    struct Options {
        DirectLight direct = DirectLight::mis;
        bool storage_buffers = false;
        BvhQuality bvh_quality = BvhQuality::balanced;
        LightChoice lights = LightChoice::tree;
        EnvironmentSampling environment_sampling = EnvironmentSampling::inversion;
        bool changes = false;  ///< the same programs will draw it with more or fewer lights
    };

    /// Throws InputError, with the numbers, where the scene is larger than the device's buffers may be.
    GpuScene(gpu::Device& device, const Scene& scene, const Effects& effects, const Options& options);
    GpuScene(const GpuScene&) = delete;
    GpuScene& operator=(const GpuScene&) = delete;
    ~GpuScene() = default;

    /// Every buffer and image by its name in the shaders.
    [[nodiscard]] std::vector<gpu::BoundResource> resources() const;
    /// Where its surfaces are, for the frame behind, by names in the shaders.
    [[nodiscard]] std::vector<gpu::BoundResource> previousResources() const;
    /// What the scene says to every frame: counts, sizes, seeds are the caller's.
    void describe(FrameRecord& frame) const;
    /// The effects, and what else is compiled in: how the BVH is fetched, where instances begin, and so on.
    [[nodiscard]] gpu::SpecConstants constants() const;

    /// One per baked instance, one per group of instances of a mesh.
    [[nodiscard]] const std::vector<Draw>& draws() const { return geometry_.draws(); }
    /// Memory on the device for vertices, triangles, instances and the BVH.
    [[nodiscard]] std::uint64_t geometryBytes() const { return geometry_bytes_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    [[nodiscard]] double bvhSeconds() const { return levels_.buildSeconds(); }
    [[nodiscard]] std::uint32_t bvhDropped() const { return levels_.dropped(); }

private:
    gpu::Buffer none_;
    Effects effects_;
    GpuLights lights_;
    GpuGeometry geometry_;
    GpuLevels levels_;
    GpuMaterials materials_;
    GpuTextures textures_;
    RecordViews records_;
    Bounds bounds_;
    std::uint64_t geometry_bytes_ = 0;
};

}  // namespace licht
