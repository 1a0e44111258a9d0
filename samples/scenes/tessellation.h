#pragma once
// How finely to cut a surface for a wanted count of triangles.
#include <cstdint>

namespace licht {

/// Columns and rows of quads, about as many of one as of the other, that give that many triangles as nearly
/// as any.
struct GridCut {
    std::uint32_t columns;
    std::uint32_t rows;
    [[nodiscard]] std::uint64_t triangles() const { return std::uint64_t{2} * columns * rows; }
};
GridCut cutGrid(std::uint64_t triangles);

/// Segments and rings of a sphere (shapes.h) of about that many triangles, at least 12.
struct SphereCut {
    std::uint32_t segments;
    std::uint32_t rings;
    [[nodiscard]] std::uint64_t triangles() const { return std::uint64_t{2} * segments * (rings - 1); }
};
SphereCut cutSphere(std::uint64_t triangles);

}  // namespace licht
