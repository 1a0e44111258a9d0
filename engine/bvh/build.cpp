#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

#include "licht/bvh/binary_tree.h"
#include "licht/bvh/ray_setup.h"
#include "licht/bvh/reinsert.h"
#include "licht/core/clock.h"
#include "licht/core/error.h"

namespace licht {
namespace {

constexpr std::uint32_t kBlock = 4096;

/// The usable triangles, in order, at the front. Returns how many they are.
std::uint32_t makeReferences(std::span<const BvhTriangle> triangles, std::span<BuildReference> references) {
    const auto count = static_cast<std::uint32_t>(triangles.size());
    const std::uint32_t blocks = (count + kBlock - 1) / kBlock;
    std::vector<std::uint32_t> kept(blocks);
    tbb::parallel_for(0U, blocks, [&](std::uint32_t block) {
        std::uint32_t to = block * kBlock;
        for (std::uint32_t i = to; i < std::min((block + 1) * kBlock, count); ++i) {
            if (isUsable(triangles[i])) {
                references[to++] = {boundsOf(triangles[i]), i};
            }
        }
        kept[block] = to - block * kBlock;
    });
    std::uint32_t total = 0;
    for (std::uint32_t block = 0; block < blocks; ++block) {
        if (total != block * kBlock) {
            const auto from = references.begin() + block * kBlock;
            std::copy(from, from + kept[block], references.begin() + total);
        }
        total += kept[block];
    }
    return total;
}

}  // namespace

Bvh buildBvh(std::span<const BvhTriangle> triangles, const BvhBuildOptions& options) {
    const Clock::time_point start = Clock::now();
    if (triangles.size() > kBvhMostTriangles) {
        throw InputError("the scene has " + std::to_string(triangles.size()) + " triangles, at most " +
                         std::to_string(kBvhMostTriangles) + " can be traced");
    }
    Bvh bvh;
    bvh.input_triangles = static_cast<std::uint32_t>(triangles.size());
    const auto build = [&] {
        Uninitialised<BuildReference> references(triangles.size());
        const std::uint32_t count = makeReferences(triangles, references.span());
        bvh.dropped = bvh.input_triangles - count;
        Uninitialised<BinaryNode> nodes(count == 0 ? 0 : 2 * std::size_t{count} - 1);
        const auto own = references.span().first(count);
        if (count > 0 && options.quality == BvhQuality::fast) {
            buildMorton(own, nodes.span());
        } else if (count > 0) {
            const Uninitialised<BuildReference> scratch(count);
            buildBinary(own, scratch.span(), nodes.span());
        }
        return nodes;
    };
    const Uninitialised<BinaryNode> nodes = build();
    if (!nodes.span().empty()) {
        bvh.bounds = nodes[0].box().bounds();
    }
    if (options.quality == BvhQuality::best) {
        reinsert(nodes.span());
    }
    collapse(nodes.span(), bvh);
    bvh.build_seconds = secondsSince(start);
    return bvh;
}

}  // namespace licht
