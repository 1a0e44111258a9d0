#pragma once
#include "licht/gpu/resource.h"

namespace licht::gpu {

/// How a pass touches a resource. One table (barriers.cpp) says which stage, access and image layout each
/// means.
enum class Access {
    compute_read,   ///< storage or uniform buffer, texel buffer; storage image read
    compute_write,  ///< storage, written without being read
    compute_read_write,
    compute_sample,  ///< sampled image
    indirect_read,   ///< VkDispatchIndirectCommand
    raster_read,     ///< buffers and sampled images in vertex and fragment shaders
    color_target,    ///< cleared or overwritten
    depth_target,
    transfer_read,
    transfer_write,
    present,
};

struct Use {
    Use(const Buffer* buffer, Access how) : resource(&buffer->tracked()), access(how) {}
    Use(const Image* image, Access how) : resource(&image->tracked()), access(how) {}
    Use(Tracked& tracked, Access how) : resource(&tracked), access(how) {}
    Tracked* resource;
    Access access;
};

}  // namespace licht::gpu
