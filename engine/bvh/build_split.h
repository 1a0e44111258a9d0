#pragma once
#include <cstdint>
#include <span>

#include "licht/bvh/build_box.h"

namespace licht {

/// References that a binary node holds.
struct BuildRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    Box bounds;
};

struct BuildHalves {
    BuildRange left;
    BuildRange right;
};

/// The references in one of two buffers; a split may move a range into the other one.
struct BuildBuffers {
    BuildReference* references;
    BuildReference* scratch;
};

/// The references, which begin at position `first`, and their box.
BuildRange measureRange(std::span<const BuildReference> references, std::uint32_t first);

/// Wald 2007, On fast Construction of SAH-based Bounding Volume Hierarchies.
/// Keeps the order within each half, so that no number of threads changes the result. Large ranges are worked
/// on by all threads and change buffers.
BuildHalves splitBinned(BuildBuffers& buffers, const BuildRange& range);

/// Two halves of equal count along the widest axis, for when the depth runs out.
BuildHalves splitMiddle(BuildBuffers& buffers, const BuildRange& range);

}  // namespace licht
