#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "licht/bvh/build_box.h"
#include "licht/bvh/bvh.h"

namespace licht {

/// Memory that its users fill in parallel: touching it first elsewhere would cost a pass.
template <typename T>
class Uninitialised {
public:
    explicit Uninitialised(std::size_t size)
        : data_(std::make_unique_for_overwrite<T[]>(size)), size_(size) {}
    [[nodiscard]] std::span<T> span() const { return {data_.get(), size_}; }
    T& operator[](std::size_t i) const { return data_[i]; }

private:
    std::unique_ptr<T[]> data_;
    std::size_t size_;
};

/// An inner node with two children, or a leaf with one triangle.
struct alignas(32) BinaryNode {
    vec3 lower;
    std::uint32_t left;  ///< index of the left child; of a leaf: the index of the triangle
    vec3 upper;
    std::uint32_t right;  ///< index of the right child; 0: a leaf

    [[nodiscard]] bool isLeaf() const { return right == 0; }
    [[nodiscard]] Box box() const { return std::bit_cast<Box>(*this); }
    [[nodiscard]] float halfArea() const { return box().halfArea(); }
    void setBox(const Box& box) {
        lower = {box.lower[0], box.lower[1], box.lower[2]};
        upper = {box.upper[0], box.upper[1], box.upper[2]};
    }
};
static_assert(sizeof(BinaryNode) == sizeof(Box));

/// The most levels that a binary tree of that many triangles may have, whatever was done to it.
std::uint32_t binaryDepthLimit(std::uint32_t triangles);

/// By binned SAH. Writes the 2 * references.size() - 1 nodes, the root first and each node before its
/// children. Reorders the references; there must be at least one.
void buildBinary(std::span<BuildReference> references, std::span<BuildReference> scratch,
                 std::span<BinaryNode> nodes);

/// The same along a space-filling curve, in less time.
void buildMorton(std::span<const BuildReference> references, std::span<BinaryNode> nodes);

/// The tree over any boxes that are not empty, by binned SAH; its leaves hold indices of boxes.
/// Empty without boxes.
std::vector<BinaryNode> buildBinary(std::span<const Bounds> boxes);

/// Appends the wide tree of a binary one (empty: a root without children) to bvh and sets its triangle_ids,
/// depth, max_stack, sah_cost and triangle_area.
void collapse(std::span<const BinaryNode> binary, Bvh& bvh);

}  // namespace licht
