// What the tests of hard cases share: how many rays, the two ways of tracing them, and closed meshes.
// LICHT_NIGHTLY=1 in the environment chooses the large counts: minutes to an hour instead of seconds.
#pragma once
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "licht/bvh/bvh.h"
#include "support/tracer.h"
#include "unit/bvh_meshes.h"

namespace licht::test {

inline bool nightly() {
    const char* wanted = std::getenv("LICHT_NIGHTLY");
    return wanted != nullptr && std::string_view(wanted) == "1";
}

/// The count for the suite, or for the night.
inline std::size_t often(std::size_t suite, std::size_t night) {
    return nightly() ? night : suite;
}

enum class Where { host, device };

using Hits = std::vector<std::optional<BvhHit>>;

/// The same rays through the reference on the host or the shader on the device.
class Caster {
public:
    Caster(std::vector<BvhTriangle> triangles, Where where) {
        if (where == Where::device) {
            device_ = std::make_unique<Tracer>(std::move(triangles));
        } else {
            triangles_ = std::move(triangles);
            bvh_ = buildBvh(triangles_);
        }
    }

    [[nodiscard]] const Bvh& bvh() const { return device_ ? device_->bvh() : bvh_; }
    [[nodiscard]] const std::vector<BvhTriangle>& triangles() const {
        return device_ ? device_->triangles() : triangles_;
    }

    /// Nearest hits; on the device also demands that no traversal was truncated.
    Hits nearest(const std::vector<Ray>& rays) { return trace(rays, 0.0F); }
    /// Some hit of each ray; the host has no walk of its own for that.
    Hits any(const std::vector<Ray>& rays) { return trace(rays, kInfinity); }

private:
    Hits trace(const std::vector<Ray>& rays, float t_enough) {
        if (device_) {
            Hits hits = device_->trace(rays, {0, t_enough, 0, 0});
            EXPECT_EQ(device_->truncated(), 0);
            return hits;
        }
        Hits hits;
        hits.reserve(rays.size());
        for (const Ray& ray : rays) {
            hits.push_back(intersect(bvh_, triangles_, ray));
        }
        return hits;
    }

    std::vector<BvhTriangle> triangles_;
    Bvh bvh_;
    std::unique_ptr<Tracer> device_;
};

/// Bit for bit, but for the sign of a zero.
inline bool same(const std::optional<BvhHit>& a, const std::optional<BvhHit>& b) {
    return a.has_value() == b.has_value() &&
           (!a || (a->triangle == b->triangle && a->t == b->t && a->b1 == b->b1 && a->b2 == b->b2));
}

/// How many rays the two disagree about.
inline std::size_t differences(const Hits& a, const Hits& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        count += same(a[i], b[i]) ? 0U : 1U;
    }
    return count;
}

inline std::size_t missesOf(const Hits& hits) {
    std::size_t count = 0;
    for (const auto& hit : hits) {
        count += hit ? 0U : 1U;
    }
    return count;
}

/// Moves every vertex of a sphere along its own radius by up to that share of it. What is moved follows from
/// the vertex's bits, so that triangles that met still meet.
inline Mesh noisy(Mesh mesh, const vec3& centre, float share) {
    const auto moved = [&](const vec3& v) {
        const std::uint32_t seed = std::bit_cast<std::uint32_t>(v.x) * 0x9e3779b9U ^
                                   std::bit_cast<std::uint32_t>(v.y) * 0x85ebca6bU ^
                                   std::bit_cast<std::uint32_t>(v.z) * 0xc2b2ae35U;
        return v + (v - centre) * Random(seed).uniform(-share, share);
    };
    for (vec3& v : mesh.vertices) {
        v = moved(v);
    }
    for (BvhTriangle& t : mesh.triangles) {
        t = {moved(t.v0), moved(t.v1), moved(t.v2)};
    }
    return mesh;
}

/// Rays from near a closed mesh's centre: in turn to anywhere, exactly to a vertex, and to the middle of an
/// edge; every fifth from the centre itself.
inline std::vector<Ray> raysFromWithin(const Mesh& mesh, const vec3& centre, float inside, std::size_t count,
                                       Random& random) {
    std::vector<Ray> rays;
    rays.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const vec3 origin = i % 5 == 0 ? centre : centre + random.inCube(inside);
        vec3 direction = random.direction();
        if (i % 3 == 1) {
            direction = mesh.vertices[random.index(mesh.vertices.size())] - origin;
        } else if (i % 3 == 2) {
            const BvhTriangle& t = mesh.triangles[random.index(mesh.triangles.size())];
            direction = 0.5F * (t.v0 - origin) + 0.5F * (t.v1 - origin);
        }
        rays.push_back({origin, direction});
    }
    return rays;
}

inline double areaOf(const std::vector<BvhTriangle>& triangles) {
    double sum = 0.0;
    for (const BvhTriangle& t : triangles) {
        const glm::dvec3 a(t.v0);
        sum += 0.5 * glm::length(glm::cross(glm::dvec3(t.v1) - a, glm::dvec3(t.v2) - a));
    }
    return sum;
}

/// Of a closed mesh whose triangles are all wound the same way.
inline double volumeOf(const std::vector<BvhTriangle>& triangles) {
    double sum = 0.0;
    for (const BvhTriangle& t : triangles) {
        sum += glm::dot(glm::dvec3(t.v0), glm::cross(glm::dvec3(t.v1), glm::dvec3(t.v2))) / 6.0;
    }
    return std::abs(sum);
}

/// An axis-aligned cube of that half width around the origin, faces outward.
inline std::vector<BvhTriangle> cube(float half) {
    std::vector<BvhTriangle> triangles;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-half, half}) {
            const auto corner = [&](float u, float v) {
                vec3 p;
                p[axis] = side;
                p[(axis + 1) % 3] = side > 0.0F ? u : v;
                p[(axis + 2) % 3] = side > 0.0F ? v : u;
                return p;
            };
            triangles.push_back({corner(-half, -half), corner(half, -half), corner(half, half)});
            triangles.push_back({corner(-half, -half), corner(half, half), corner(-half, half)});
        }
    }
    return triangles;
}

/// A test that runs on the host and on the device.
class OnBoth : public testing::TestWithParam<Where> {};

inline std::string nameOfWhere(const testing::TestParamInfo<Where>& info) {
    return info.param == Where::host ? "host" : "device";
}

}  // namespace licht::test
