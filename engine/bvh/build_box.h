#pragma once
#include <bit>
#include <cstdint>

#include "licht/core/math.h"

namespace licht {

/// Four lanes at once; GCC and clang know the attribute on every processor.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 smaller(Float4 a, Float4 b) {
    return a < b ? a : b;
}
inline Float4 larger(Float4 a, Float4 b) {
    return a > b ? a : b;
}
inline Float4 four(float value) {
    return Float4{value, value, value, value};
}

/// A box in two registers; lane 3 is nobody's. The default is empty.
struct Box {
    Float4 lower = four(kInfinity);
    Float4 upper = four(-kInfinity);

    void extend(const Box& other) {
        lower = smaller(lower, other.lower);
        upper = larger(upper, other.upper);
    }
    /// Twice the centre, which spares a product that could not change any comparison.
    [[nodiscard]] Float4 centre2() const { return lower + upper; }
    /// Half of the surface area; not for empty boxes.
    [[nodiscard]] float halfArea() const {
        const Float4 size = upper - lower;
        return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
    [[nodiscard]] Bounds bounds() const {
        return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
    }
};

/// The box of a triangle, and in lane 3 which one.
struct BuildReference : Box {
    BuildReference() = default;
    BuildReference(const Bounds& bounds, std::uint32_t id)
        : Box{{bounds.lower.x, bounds.lower.y, bounds.lower.z, std::bit_cast<float>(id | kTag)},
              {bounds.upper.x, bounds.upper.y, bounds.upper.z, 0.0F}} {}

    [[nodiscard]] std::uint32_t id() const { return std::bit_cast<std::uint32_t>(lower[3]) & ~kTag; }

private:
    static constexpr std::uint32_t kTag = 0x40000000U;  // makes any index a normal number, quick to add
};

}  // namespace licht
