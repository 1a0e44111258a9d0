#pragma once
// Another ray tracer that answers the same questions about the same triangles, to measure by: Intel's Embree.
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/shared/ray_records.h"

namespace licht {

/// How rays are handed over: one by one, or in packets of neighbours in the list. A coherent packet is
/// announced as rays that go the same way.
struct YardstickCall {
    std::uint32_t width = 1;  ///< 1, 8 or 16
    bool coherent = false;
};

class Yardstick {
public:
    Yardstick() = default;
    Yardstick(const Yardstick&) = delete;
    Yardstick& operator=(const Yardstick&) = delete;
    virtual ~Yardstick() = default;

    [[nodiscard]] virtual std::string version() const = 0;  ///< "3.13.5"
    [[nodiscard]] virtual double buildSeconds() const = 0;
    [[nodiscard]] virtual std::uint32_t threads() const = 0;
    /// What this processor runs.
    [[nodiscard]] virtual std::vector<YardstickCall> packetCalls() const = 0;
    /// Traces the list on all cores and gives the seconds that took. `hits` is as long as `rays`; any_hit
    /// sets no more than whether a triangle was hit (kNoIndex or not).
    virtual double trace(std::span<const RayRecord> rays, bool any_hit, const YardstickCall& call,
                         std::span<RayHitRecord> hits) = 0;
};

/// Built over these triangles, whose positions in the list are the hits' triangle numbers. `robust` asks for
/// a search that misses nothing at edges. Null where Embree is not installed.
std::unique_ptr<Yardstick> makeYardstick(std::span<const BvhTriangle> triangles, bool robust);

}  // namespace licht
