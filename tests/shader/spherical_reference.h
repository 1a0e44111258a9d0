#pragma once
// Triangles and rectangles as solid angles in double precision, by definition and by textbook formulas: the
// naive reference of pure/spherical.glsl, and how far fp32 may be from it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "licht/core/math.h"

namespace licht::test {

using glm::dvec2;
using glm::dvec3;

constexpr double kRounding = 0x1p-24;  ///< relative error of one rounding to fp32

/// What tests/shader/spherical.comp is asked for.
enum Shape : std::uint32_t { kTriangle, kRectangle, kCone, kArctangent, kLimits, kInsideCone };

struct Patch {
    Shape shape = kTriangle;
    dvec3 a, b, c;  // vertices, or a corner and two edges, as fp32 holds them
};

inline dvec3 rounded(dvec3 v) {
    return dvec3(vec3(v));
}

inline Patch triangle(dvec3 a, dvec3 b, dvec3 c) {
    return {kTriangle, rounded(a), rounded(b), rounded(c)};
}

inline Patch rectangle(dvec3 corner, dvec3 edge_u, dvec3 edge_v) {
    return {kRectangle, rounded(corner), rounded(edge_u), rounded(edge_v)};
}

/// Van Oosterom and Strackee 1983, The Solid Angle of a Plane Triangle; with sign.
inline double signedAngle(dvec3 a, dvec3 b, dvec3 c) {
    const double la = length(a), lb = length(b), lc = length(c);
    return 2.0 * std::atan2(dot(a, cross(b - a, c - a)),
                            la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

inline double solidAngle(const Patch& p) {
    if (p.shape == kTriangle) return std::abs(signedAngle(p.a, p.b, p.c));
    const dvec3 across = p.a + p.b + p.c;
    return std::abs(signedAngle(p.a, p.a + p.b, across)) + std::abs(signedAngle(p.a, across, p.a + p.c));
}

/// How far fp32 may be off in the solid angle, relative, to first order. Vulkan's 2 ulp for inversesqrt make
/// a direction 6.5 roundings, so a cosine 16 and the sum of three 60; the volume is 20 of its own and, by the
/// cancellation within the triple product, 14 of the product of lengths. Angles pass both on by their
/// derivative; the arctangent adds 8, the product of complex numbers another 8.
inline double angleBound(const Patch& p) {
    const auto half = [](dvec3 a, dvec3 b, dvec3 c, double lost_volume, double lost_sum) {
        const double lengths = length(a) * length(b) * length(c);
        const double volume = std::abs(dot(a, cross(b - a, c - a))) / lengths;
        const double sum = 1.0 + dot(a, b) / (length(a) * length(b)) + dot(b, c) / (length(b) * length(c)) +
                           dot(c, a) / (length(c) * length(a));
        const double off_volume = 20.0 * kRounding * volume + 14.0 * kRounding * lost_volume / lengths;
        return (std::abs(sum) * off_volume + volume * 60.0 * kRounding * lost_sum) /
               (volume * volume + sum * sum);
    };
    if (p.shape == kTriangle) {
        const double product = length(p.a) * length(p.b - p.a) * length(p.c - p.a);
        return 2.0 * half(p.a, p.b, p.c, product, 1.0) / solidAngle(p) + 8.0 * kRounding;
    }
    // All follows from the corner, whose rounding in the rectangle's frame (a unit vector and a dot product,
    // for the distance a cross product too: 28 of its length) counts more the nearer another corner is.
    const dvec3 across = p.a + p.b + p.c;
    const double product = 2.0 * length(p.a) * length(p.b) * length(p.c);
    const double nearest = std::min({length(p.a), length(p.a + p.b), length(p.a + p.c), length(across)});
    const double reach = (length(p.a) + length(p.b) + length(p.c)) / nearest;
    return 2.0 *
               (half(p.a, p.a + p.b, across, product, reach) + half(p.a, across, p.a + p.c, product, reach)) /
               solidAngle(p) +
           16.0 * kRounding;
}

/// The point of the patch's unit square; a triangle's is the half below its diagonal.
inline dvec3 pointAt(const Patch& p, dvec2 at) {
    return p.shape == kTriangle ? p.a + at.x * (p.b - p.a) + at.y * (p.c - p.a)
                                : p.a + at.x * p.b + at.y * p.c;
}

/// Where the ray along w meets the patch's plane, in the same coordinates.
inline dvec2 placeOf(const Patch& p, dvec3 w) {
    const dvec3 e = p.shape == kTriangle ? p.b - p.a : p.b, f = p.shape == kTriangle ? p.c - p.a : p.c;
    const dvec3 n = cross(e, f);
    const dvec3 from_corner = w * (dot(p.a, n) / dot(w, n)) - p.a;
    return dvec2(dot(cross(from_corner, f), n), dot(cross(e, from_corner), n)) / dot(n, n);
}

/// (u.x, u.y) that lead to w, by definition: shares of solid angle, found independently of the sampler's
// formulas.
inline dvec2 inverse(const Patch& p, dvec3 w) {
    const double whole = solidAngle(p);
    if (p.shape == kTriangle) {
        dvec3 x = cross(cross(p.b, w), cross(p.a, p.c));
        x = normalize(dot(x, normalize(p.a) + normalize(p.c)) < 0.0 ? -x : x);
        const dvec3 arc = normalize(w) - normalize(p.b), all = x - normalize(p.b);
        return {std::abs(signedAngle(p.a, p.b, x)) / whole, dot(arc, arc) / dot(all, all)};
    }
    const double x = placeOf(p, w).x;
    const dvec3 low = p.a + x * p.b, up = normalize(p.c);
    const auto sine = [&](dvec3 v) { return dot(v, up) / length(v); };
    return {std::copysign(solidAngle({kRectangle, p.a, x * p.b, p.c}), x) / whole,
            (sine(w) - sine(low)) / (sine(low + p.c) - sine(low))};
}

/// The angle between a unit direction and the nearest direction of the patch.
inline double outside(const Patch& p, dvec3 w) {
    std::vector<dvec3> v{p.a, p.b, p.c};
    if (p.shape == kRectangle) v = {p.a, p.a + p.b, p.a + p.b + p.c, p.a + p.c};
    const double turn = dot(v[0], cross(v[1] - v[0], v[2] - v[0])) < 0.0 ? -1.0 : 1.0;
    double nearest = 4.0;
    bool inside = true;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const dvec3 a = normalize(v[i]), b = normalize(v[(i + 1) % v.size()]);
        const dvec3 n = turn * normalize(cross(v[i], v[(i + 1) % v.size()] - v[i]));
        const double height = dot(w, n);
        inside = inside && height >= 0.0;
        const bool beside = dot(cross(n, a), w) * turn >= 0.0 && dot(cross(b, n), w) * turn >= 0.0;
        nearest = std::min({nearest, beside ? std::abs(height) : 4.0, length(w - a), length(w - b)});
    }
    return inside ? 0.0 : nearest;
}

/// How far a sampled direction may be off, in radians. 16 roundings of unit vectors. A rectangle's point w is
/// rounded 6 times as coarsely as the shape's size, however near it is. A triangle's arcs start at b and are
/// steered by where they end, which tells less the nearer that is to the point opposite to b; there a
/// rounding of the cosine is a large step as well.
inline double directionBound(const Patch& p, dvec3 w) {
    if (p.shape == kRectangle)
        return (16.0 + 6.0 * (length(p.a) + length(p.b) + length(p.c)) / length(w)) * kRounding;
    const dvec3 b = normalize(p.b);
    dvec3 x = cross(cross(b, w), cross(p.a, p.c));
    x = normalize(dot(x, normalize(p.a) + normalize(p.c)) < 0.0 ? -x : x);
    return 16.0 * kRounding * (1.0 + length(cross(b, normalize(w))) / length(cross(b, x)));
}

/// Lambert 1760, Photometria: irradiance over pi of a polygon of radiance 1 that is above the horizon.
inline double formFactor(const std::vector<dvec3>& v, dvec3 normal) {
    dvec3 sum(0.0);
    for (std::size_t i = 0; i < v.size(); ++i) {
        const dvec3 a = v[i], b = v[(i + 1) % v.size()], n = cross(a, b);
        sum += std::atan2(length(n), dot(a, b)) * normalize(n);
    }
    return std::abs(dot(sum, normal)) / (2.0 * std::numbers::pi);
}

/// Shapes of all sizes, distances, tilts and aspects, some of them right above the origin, that solid angle
// sampling is meant for.
inline std::vector<Patch> randomPatches(Shape shape, std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    std::normal_distribution<double> normal;
    const auto direction = [&] { return normalize(dvec3(normal(random), normal(random), normal(random))); };
    std::vector<Patch> patches;
    while (patches.size() < count) {
        const dvec3 n = direction(), s = normalize(cross(n, direction())), t = cross(n, s);
        const double aspect = std::pow(10.0, -2.0 * uniform(random) * uniform(random));
        const double size = std::pow(10.0, -3.0 * uniform(random));
        const double aside = patches.size() % 3 == 0 ? 0.0 : std::pow(10.0, -2.0 + 3.0 * uniform(random));
        const dvec3 centre = n * std::pow(10.0, -3.0 * uniform(random)) + size * aside * s;
        const double phi = 2.0 * std::numbers::pi * uniform(random);
        const dvec3 x = size * (std::cos(phi) * s + std::sin(phi) * t),
                    y = size * aspect * cross(n, normalize(x));
        const auto vertex = [&] { return centre + normal(random) * x + normal(random) * y; };
        const Patch p = shape == kTriangle
                            ? triangle(vertex(), vertex(), vertex())
                            : rectangle(centre - uniform(random) * x - uniform(random) * y, x, y);
        const double angle = solidAngle(p);
        if (angle > 1e-7 && angle < 6.2) patches.push_back(p);
    }
    return patches;
}

/// Tiny, of middle size, oblique, nearly the hemisphere, slivers and edge on; all tilted, so that no frame is
// a special case.
inline std::vector<Patch> namedPatches(Shape shape) {
    const dvec3 n = normalize(dvec3(0.3, -0.7, 0.5)), s = normalize(cross(n, dvec3(0.1, 0.2, 1.0))),
                t = cross(n, s);
    const auto at = [&](double x, double y, double z) { return x * s + y * t + z * n; };
    if (shape == kTriangle)
        return {triangle(at(1, 2, 3), at(1.005, 2, 3), at(1, 2.008, 3)),
                triangle(at(-1, -1, 1), at(2, -0.5, 1), at(0.3, 1.5, 1.4)),
                triangle(at(1, 0, 0.1), at(9, 1, 0.1), at(3, 4, 0.1)),
                triangle(at(-3, -2, 0.03), at(3, -2, 0.03), at(0, 3, 0.03)),
                triangle(at(-2, 0, 1), at(2, 0, 1), at(0.5, 0.01, 1)),
                triangle(at(-1, 0.002, 0.01), at(1, 0, 0.01), at(0, 1, 0.011))};
    return {rectangle(at(1, 2, 3), 0.005 * s, 0.008 * t), rectangle(at(-1, -0.5, 1), 3.0 * s, 1.5 * t),
            rectangle(at(1, 1, 0.1), 8.0 * s, 4.0 * t),   rectangle(at(-2, -3, 0.04), 4.0 * s, 5.0 * t),
            rectangle(at(-2, 0.1, 1), 4.0 * s, 0.01 * t), rectangle(at(0, 0, 0.02), 1.0 * s, 3.0 * t)};
}

}  // namespace licht::test
