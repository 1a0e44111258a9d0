// Where lamps are held: on walls, in niches, at pillars, under ceilings.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "samples/scenes/lamps.h"
#include "samples/scenes/pattern.h"

namespace licht::lamps {
namespace {

constexpr std::uint32_t kSeed = 1989;
constexpr vec3 kUp{0, 1, 0};
constexpr vec3 kDown{0, -1, 0};
constexpr vec3 kForward{0, 0, -1};

/// What chance says of one attempt.
struct Draw {
    std::uint32_t bays;
    float share;   ///< of the way down the hall
    float side;    ///< -1 left, 1 right
    float a, b;    ///< uniform in [0, 1)
    float radius;  ///< of the lamp
};

float bayStart(const Draw& d) {
    return -kBay * std::floor(d.share * static_cast<float>(d.bays));
}
float nicheMiddle(const Draw& d) {
    return bayStart(d) - 0.5F * kBay;
}
/// Between two ribs.
float inBay(const Draw& d, float margin) {
    return bayStart(d) - glm::mix(margin, kBay - margin, d.b);
}
float pillarZ(const Draw& d) {
    const float k = std::floor(d.share * static_cast<float>(d.bays - 1)) + 1.0F;
    return -kBay * k;
}

Mount flat(const vec3& place, const vec3& normal, const vec3& along) {
    return {place, normal, along, place};
}
Mount hung(const vec3& place, float ceiling) {
    return {place, kDown, kForward, {place.x, ceiling, place.z}};
}
Mount standing(const vec3& place) {
    return {place, kUp, kForward, place};
}
vec3 inward(const Draw& d) {
    return {-d.side, 0, 0};
}

Mount betweenNiches(const Draw& d) {
    return flat({d.side * kWall, glm::mix(0.9F, 3.0F, d.a), pillarZ(d) + glm::mix(-0.5F, 0.5F, d.b)},
                inward(d), kUp);
}
Mount clerestory(const Draw& d) {
    return flat({d.side * kNave, glm::mix(4.5F, 5.6F, d.a), inBay(d, 0.5F)}, inward(d), kForward);
}
Mount aisleCeiling(const Draw& d) {
    return flat({d.side * glm::mix(kAisle + 0.5F, kWall - 0.5F, d.a), kAisleHeight, inBay(d, 0.7F)}, kDown,
                kForward);
}
Mount naveCeiling(const Draw& d) {
    return flat({d.side * glm::mix(0.0F, kNave - 0.5F, d.a), kNaveHeight, inBay(d, 0.7F)}, kDown, kForward);
}
Mount nicheBack(const Draw& d) {
    return flat({d.side * kNicheBack, glm::mix(1.45F, 2.15F, d.a), nicheMiddle(d)}, inward(d), kUp);
}
/// Faces the other jamb: only the niche and what it reflects are lit.
Mount nicheJamb(const Draw& d) {
    const bool near = d.b < 0.5F;
    return flat({d.side * 0.5F * (kWall + kNicheBack), glm::mix(1.45F, 2.15F, d.a),
                 bayStart(d) - (near ? kNicheStart : kNicheEnd)},
                near ? kForward : -kForward, kUp);
}
Mount endWall(const Draw& d) {
    return flat({d.side * glm::mix(0.0F, kNave - 0.5F, d.a), glm::mix(0.8F, 5.6F, d.b),
                 -kBay * static_cast<float>(d.bays)},
                -kForward, kUp);
}
Mount skirting(const Draw& d) {
    return flat({d.side * kWall, 0.2F, nicheMiddle(d)}, inward(d), kForward);
}
Mount underBeam(const Draw& d) {
    return flat({d.side * kPillarX, kArch, nicheMiddle(d)}, kDown, kForward);
}
Mount cornice(const Draw& d) {
    return flat({d.side * kNave, 4.05F, nicheMiddle(d)}, inward(d), kForward);
}
Mount besideNiche(const Draw& d) {
    return flat({d.side * kWall, glm::mix(1.4F, 2.4F, d.a), pillarZ(d) + (d.b < 0.5F ? -0.8F : 0.8F)},
                inward(d), kUp);
}
Mount navePendant(const Draw& d) {
    return hung({d.side * glm::mix(0.3F, kNave - 0.6F, d.a), glm::mix(3.2F, 5.4F, d.b), inBay(d, 0.5F)},
                kNaveHeight);
}
Mount aislePendant(const Draw& d) {
    return hung(
        {d.side * glm::mix(kAisle + 0.5F, kWall - 0.5F, d.a), glm::mix(2.2F, 3.3F, d.b), inBay(d, 0.5F)},
        kAisleHeight);
}
Mount atPillar(const Draw& d) {
    const float angle = 2.0F * kPi * d.a;
    const vec3 out{std::cos(angle), 0.0F, std::sin(angle)};
    const vec3 axis{d.side * kPillarX, glm::mix(0.9F, 2.9F, d.b), pillarZ(d)};
    return {axis + (kPillarRadius + 0.08F + d.radius) * out, out, kUp, axis};
}
Mount onSill(const Draw& d) {
    return standing(
        {d.side * (kWall + 0.25F), kNicheSill + d.radius, nicheMiddle(d) + glm::mix(-0.5F, 0.5F, d.a)});
}
Mount onFloor(const Draw& d) {
    return standing({d.side * glm::mix(kWall - 0.6F, kWall - 0.3F, d.a), d.radius, inBay(d, 0.3F)});
}

using Maker = Mount (*)(const Draw&);
// A maker that is listed twice is chosen twice as often.
constexpr std::array<Maker, 10> kPanelMounts{betweenNiches, betweenNiches, clerestory, aisleCeiling,
                                             naveCeiling,   nicheBack,     nicheBack,  nicheJamb,
                                             nicheJamb,     endWall};
constexpr std::array<Maker, 4> kStripMounts{skirting, underBeam, cornice, besideNiche};
constexpr std::array<Maker, 8> kSphereMounts{atPillar,     atPillar, atPillar, navePendant,
                                             aislePendant, onSill,   onFloor,  onFloor};
constexpr std::array<Maker, 4> kShardsMounts{navePendant, navePendant, aislePendant, atPillar};

std::span<const Maker> mountsOf(Kind kind) {
    switch (kind) {
        case Kind::panel:
            return kPanelMounts;
        case Kind::strip:
            return kStripMounts;
        case Kind::sphere:
            return kSphereMounts;
        case Kind::shards:
            break;
    }
    return kShardsMounts;
}

}  // namespace

Mount chooseMount(std::uint32_t bays, Kind kind, float share, float radius, std::uint32_t attempt) {
    const auto drawn = [attempt](std::uint32_t what) { return hashed(attempt, what, kSeed); };
    const std::span<const Maker> makers = mountsOf(kind);
    const auto choice = static_cast<std::size_t>(drawn(0) * static_cast<float>(makers.size()));
    return makers[choice]({bays, share, drawn(1) < 0.5F ? -1.0F : 1.0F, drawn(2), drawn(3), radius});
}

}  // namespace licht::lamps
