#pragma once
#include <span>
#include <vector>

#include "licht/bvh/instances.h"
#include "licht/gpu/program.h"
#include "licht/gpu/resource.h"

namespace licht {

/// What shaders/ray/traversal.glsl reads, on the device: kBvhTexelsPerTriangle texels per position in the
/// leaves' order, see triangleTexels().
class GpuBvh {
public:
    GpuBvh() = default;
    /// Texel buffers, or storage buffers where `storage` asks for them or a device's texel buffers are too
    /// small. Throws InputError, with the numbers, where neither holds the tree.
    GpuBvh(gpu::Device& device, std::span<const BvhNode> nodes, std::span<const vec4> triangles,
           uint max_stack, bool storage);

    /// By their names in the shaders; what `storage` does not use is bound to a few bytes.
    void addTo(std::vector<gpu::BoundResource>& resources) const;
    void addTo(gpu::SpecConstants& constants) const;
    [[nodiscard]] bool inStorage() const { return in_storage_; }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

private:
    gpu::Buffer none_, nodes_, triangles_;
    gpu::TexelView nodes_view_, triangles_view_;
    uint max_stack_ = 1;
    bool in_storage_ = false;
    std::uint64_t bytes_ = 0;
};

/// Whether texel buffers of four words a texel hold that many bytes; every device has 65,536 texels.
bool fitTexelBuffer(std::uint64_t bytes, const VkPhysicalDeviceLimits& limits);

/// What a hit is called beside its triangle; numbers below 2^24, which floats hold exactly.
struct TriangleName {
    uint index = 0;  ///< decides between equal distances
    uint instance = 0;
    uint primitive = 0;
};

/// Appends one position's texels.
void appendTriangleTexels(std::vector<vec4>& texels, const BvhTriangle& triangle, const TriangleName& name);
/// An instance's position: the way of a ray to its object.
void appendInstanceTexels(std::vector<vec4>& texels, const BvhInstance& instance);
std::vector<vec4> triangleTexels(const Bvh& bvh, std::span<const BvhTriangle> triangles);

}  // namespace licht
