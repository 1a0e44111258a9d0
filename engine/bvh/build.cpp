#include <chrono>
#include <string>

#include "licht/bvh/binary_tree.h"
#include "licht/bvh/ray_setup.h"
#include "licht/core/error.h"

namespace licht {

Bvh buildBvh(std::span<const BvhTriangle> triangles) {
    const auto start = std::chrono::steady_clock::now();
    if (triangles.size() > kBvhFirstMask) {
        throw InputError("the scene has " + std::to_string(triangles.size()) + " triangles, at most " +
                         std::to_string(kBvhFirstMask) + " can be traced");
    }
    Bvh bvh;
    std::vector<BuildReference> references;
    references.reserve(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (!isUsable(triangles[i])) {
            ++bvh.dropped;
            continue;
        }
        const Bounds bounds = boundsOf(triangles[i]);
        bvh.bounds.extend(bounds);
        references.push_back({bounds.lower, bounds.upper, i});
    }
    collapse(references.empty() ? std::vector<BinaryNode>{} : buildBinary(references), bvh);

    bvh.triangle_ids.reserve(references.size());
    for (const BuildReference& reference : references) {
        bvh.triangle_ids.push_back(reference.id);
    }
    bvh.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return bvh;
}

}  // namespace licht
