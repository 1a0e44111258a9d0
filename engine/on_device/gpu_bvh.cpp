#include "licht/on_device/gpu_bvh.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/shared/constants.h"

namespace licht {

GpuBvh::GpuBvh(gpu::Device& device, std::span<const BvhNode> nodes, std::span<const vec4> triangles,
               uint max_stack, bool storage)
    : none_(device, "no BVH", sizeof(vec4),
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
            gpu::Memory::device),
      max_stack_(std::max(max_stack, 1U)),
      bytes_(nodes.size_bytes() + triangles.size_bytes()) {
    const std::uint64_t most_bytes = std::max(nodes.size_bytes(), triangles.size_bytes());
    in_storage_ = storage || !fitTexelBuffer(most_bytes, device.limits());
    if (in_storage_ && most_bytes > device.limits().maxStorageBufferRange)
        throw InputError(
            fmt::format("the scene's BVH has a buffer of {} bytes, and this device's buffers hold at most {} "
                        "(texel) and {} (storage)",
                        most_bytes, std::uint64_t{device.limits().maxTexelBufferElements} * sizeof(vec4),
                        device.limits().maxStorageBufferRange));
    const VkBufferUsageFlags usage =
        in_storage_ ? VK_BUFFER_USAGE_STORAGE_BUFFER_BIT : VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    nodes_ = gpu::uploadBuffer(device, "bvh_nodes", nodes, usage);
    triangles_ = gpu::uploadBuffer(device, "bvh_triangles", triangles, usage);
    nodes_view_ = gpu::TexelView(device, in_storage_ ? none_ : nodes_, VK_FORMAT_R32G32B32A32_UINT);
    triangles_view_ = gpu::TexelView(device, in_storage_ ? none_ : triangles_, VK_FORMAT_R32G32B32A32_SFLOAT);
}

void GpuBvh::addTo(std::vector<gpu::BoundResource>& resources) const {
    resources.insert(resources.end(), {{"bvh_nodes", &nodes_view_},
                                       {"bvh_triangles", &triangles_view_},
                                       {"bvh_nodes_storage", in_storage_ ? &nodes_ : &none_},
                                       {"bvh_triangles_storage", in_storage_ ? &triangles_ : &none_}});
}

void GpuBvh::addTo(gpu::SpecConstants& constants) const {
    constants[kConstantBvhInStorage] = in_storage_ ? 1U : 0U;
    constants[kConstantBvhStackSize] = max_stack_;
}

bool fitTexelBuffer(std::uint64_t bytes, const VkPhysicalDeviceLimits& limits) {
    return bytes <= std::uint64_t{limits.maxTexelBufferElements} * sizeof(vec4);
}

void appendTriangleTexels(std::vector<vec4>& texels, const BvhTriangle& triangle, const TriangleName& name) {
    texels.emplace_back(triangle.v0, static_cast<float>(name.index));
    texels.emplace_back(triangle.v1, static_cast<float>(name.instance));
    texels.emplace_back(triangle.v2, static_cast<float>(name.primitive));
}

void appendInstanceTexels(std::vector<vec4>& texels, const BvhInstance& instance) {
    const mat3 rows = glm::transpose(instance.object_from_world);
    for (int row = 0; row < 3; ++row) texels.emplace_back(rows[row], instance.pivot[row]);
}

std::vector<vec4> triangleTexels(const Bvh& bvh, std::span<const BvhTriangle> triangles) {
    std::vector<vec4> texels;
    texels.reserve(kBvhTexelsPerTriangle * bvh.triangle_ids.size());
    for (const uint id : bvh.triangle_ids) appendTriangleTexels(texels, triangles[id], {id, 0, id});
    return texels;
}

}  // namespace licht
