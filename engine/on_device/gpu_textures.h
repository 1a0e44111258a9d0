#pragma once
#include <vector>

#include "licht/gpu/program.h"
#include "licht/on_device/uploads.h"
#include "licht/scene/scene.h"

namespace licht {

/// The texels of a scene's textures on the device, see shaders/bound/texture.glsl.
class GpuTextures {
public:
    GpuTextures() = default;
    /// Throws InputError, with the numbers, where they are too many.
    GpuTextures(Uploads& uploads, const std::vector<Texture>& textures);

    void addTo(std::vector<gpu::BoundResource>& resources, const gpu::Buffer& none) const;
    void addTo(gpu::SpecConstants& constants) const;

private:
    std::vector<gpu::Buffer> pages_;
    gpu::Buffer textures_, srgb_table_;
    bool wide_texels_ = false;
};

}  // namespace licht
