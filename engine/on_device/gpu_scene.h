#pragma once
#include <string>
#include <vector>

#include "licht/gpu/program.h"
#include "licht/gpu/resource.h"
#include "licht/on_device/gpu_bvh.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"
#include "licht/shared/frame.h"
#include "licht/shared/index.h"

namespace licht {

struct FlatGeometry;
struct InstanceOrder;

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
    };

    /// Throws InputError, with the numbers, where the scene is larger than the device's buffers may be.
    GpuScene(gpu::Device& device, const Scene& scene, const Effects& effects, const Options& options);

    /// Every buffer and image by its name in the shaders.
    [[nodiscard]] std::vector<gpu::BoundResource> resources() const;
    /// What the scene says to every frame: counts, sizes, seeds are the caller's.
    void describe(FrameRecord& frame) const;
    /// Constants beside the effects: how the BVH is fetched, how deep its stack is, where instances begin.
    [[nodiscard]] gpu::SpecConstants constants() const;

    struct Draw {
        uint first_vertex;
        uint vertex_count;
        uint first_instance;
        uint instance_count;
        VkCullModeFlags cull;
    };
    /// One per baked instance, one per group of instances of a mesh.
    [[nodiscard]] const std::vector<Draw>& draws() const { return draws_; }
    /// Memory on the device for vertices, triangles, instances and the BVH.
    [[nodiscard]] std::uint64_t geometryBytes() const { return geometry_bytes_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    [[nodiscard]] double bvhSeconds() const { return bvh_seconds_; }
    [[nodiscard]] std::uint32_t bvhDropped() const { return bvh_dropped_; }

private:
    void uploadGeometry(const Scene& scene, const Effects& effects, const InstanceOrder& order,
                        const std::vector<uint>& first_light, const Options& options);
    void uploadBvh(const FlatGeometry& geometry, const Options& options);
    void addDraws(const FlatGeometry& geometry);
    void viewRecords(bool storage);
    void uploadMaterials(const Scene& scene, const Effects& effects);
    void uploadTexels(const Scene& scene);
    void uploadLights(const Scene& scene, const Effects& effects, const InstanceOrder& order,
                      const Options& options, std::vector<uint>& first_light);
    template <typename T>
    gpu::Buffer upload(const char* name, const std::vector<T>& values,
                       VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);

    gpu::Device* device_;
    gpu::Buffer none_, vertices_, triangle_indices_, instances_, materials_, tangents_, colors_, extra_uvs_,
        textures_, srgb_table_;
    gpu::Buffer instance_transforms_, lights_, light_alias_, light_tree_;
    std::vector<gpu::Buffer> texel_pages_;
    GpuBvh bvh_;
    struct RecordView {
        const char* name;
        gpu::TexelView view;
    };
    std::vector<RecordView> record_views_;
    bool records_in_storage_ = false;
    gpu::Image environment_map_, environment_table_;
    gpu::Sampler sampler_;
    std::vector<Draw> draws_;
    Bounds bounds_;
    uvec2 environment_size_{1, 1};
    float environment_peak_ = 0.0F;
    EnvironmentSampling environment_sampling_ = EnvironmentSampling::alias;
    LightChoice lights_by_ = LightChoice::power;
    uint light_slots_ = 0;
    uint tree_lights_ = 0;
    uint environment_light_ = kNoIndex;
    uint first_sun_ = 0;
    uint suns_ = 0;
    uint extra_uv_sets_ = 0;
    uint has_sky_ = 0;
    uint baked_instances_ = kNoIndex;
    uint first_instance_position_ = kNoIndex;
    uint first_instance_texel_ = 0;
    float instance_slack_ = 0.0F;
    std::uint64_t bytes_ = 0;
    std::uint64_t geometry_bytes_ = 0;
    uint slot_kinds_ = 0;
    bool wide_texels_ = false;
    double bvh_seconds_ = 0.0;
    std::uint32_t bvh_dropped_ = 0;
};

}  // namespace licht
