#pragma once
#include <vector>

#include "licht/gpu/program.h"
#include "licht/on_device/record_views.h"
#include "licht/on_device/uploads.h"
#include "licht/scene/scene.h"
#include "licht/shared/material.h"

namespace licht {

/// Materials as shaders/bound/material.glsl reads them: a record each, and a list of details in which the
/// slots of a material stand that read a texture, then the blocks of its extensions.
struct MaterialTables {
    std::vector<MaterialRecord> materials;
    std::vector<uvec4> details;
    uint slots = 0;  ///< bits 1 << kSlot... of all of them together
};
MaterialTables materialTables(const std::vector<Material>& materials);

class GpuMaterials {
public:
    GpuMaterials() = default;
    GpuMaterials(Uploads& uploads, const std::vector<Material>& materials);

    void addTo(std::vector<FetchedRecords>& records) const;
    void addTo(gpu::SpecConstants& constants) const;

private:
    gpu::Buffer materials_, details_;
    uint slots_ = 0;
};

}  // namespace licht
