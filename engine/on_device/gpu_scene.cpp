#include "licht/on_device/gpu_scene.h"

#include "licht/on_device/flat_geometry.h"
#include "licht/on_device/scene_size.h"
#include "licht/on_device/uploads.h"
#include "licht/shared/constants.h"
#include "licht/shared/effects.h"

namespace licht {

GpuScene::GpuScene(gpu::Device& device, const Scene& scene, const Effects& effects, const Options& options)
    : none_(device, "none", 256, kFetchedUsage, gpu::Memory::device), effects_(effects) {
    Uploads uploads(device);
    const InstanceOrder order = orderInstances(scene, effects);
    requireRoom(device, sizeOnDevice(scene, order), effects);
    lights_ = GpuLights(uploads, scene, effects, order,
                        {options.direct, options.lights, options.environment_sampling, options.changes});
    const std::uint64_t before = uploads.bytes();
    {
        const FlatGeometry flat = flattenGeometry(scene, effects, order, lights_.firstLights());
        geometry_ = GpuGeometry(uploads, flat);
        levels_ = GpuLevels(uploads, flat, options.bvh_quality, options.storage_buffers);
        bounds_ = flat.bounds;
        bounds_.extend(levels_.topBounds());
    }
    geometry_bytes_ = uploads.bytes() - before;
    materials_ = GpuMaterials(uploads, scene.materials);
    if (effects.has(kEffectTextures)) textures_ = GpuTextures(uploads, scene.textures);

    std::vector<FetchedRecords> records;
    geometry_.addTo(records);
    materials_.addTo(records);
    lights_.addTo(records);
    records_ = RecordViews(device, std::move(records), none_, options.storage_buffers);
}

std::vector<gpu::BoundResource> GpuScene::resources() const {
    std::vector<gpu::BoundResource> list;
    records_.addTo(list);
    geometry_.addTo(list, none_);
    levels_.addTo(list, none_);
    textures_.addTo(list, none_);
    lights_.addTo(list);
    return list;
}

std::vector<gpu::BoundResource> GpuScene::previousResources() const {
    return {{"PreviousVertices", &geometry_.vertices()},
            {"PreviousInstanceTransforms", levels_.transforms() ? &levels_.transforms() : &none_}};
}

void GpuScene::describe(FrameRecord& frame) const {
    geometry_.describe(frame);
    lights_.describe(frame);
}

gpu::SpecConstants GpuScene::constants() const {
    gpu::SpecConstants constants{{kConstantSceneInStorage, records_.inStorage() ? 1U : 0U}};
    effects_.addTo(constants);
    geometry_.addTo(constants);
    levels_.addTo(constants);
    materials_.addTo(constants);
    textures_.addTo(constants);
    lights_.addTo(constants);
    return constants;
}

}  // namespace licht
