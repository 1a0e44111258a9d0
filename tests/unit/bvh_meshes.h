// Triangles and rays that the tests of the hierarchy share.
#pragma once
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "licht/bvh/bvh.h"

namespace licht::test {

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float uniform(float lower, float upper) {
        return lower + (upper - lower) * static_cast<float>(engine_() >> 8U) * 0x1p-24F;
    }
    vec3 inCube(float half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    vec3 direction() {
        while (true) {
            const vec3 v = inCube(1.0F);
            if (glm::dot(v, v) > 0.01F && glm::dot(v, v) <= 1.0F) {
                return glm::normalize(v);
            }
        }
    }
    std::uint32_t index(std::size_t count) { return static_cast<std::uint32_t>(engine_() % count); }

private:
    std::mt19937 engine_;
};

/// Triangles of about that size in a cube of half width 1.
inline std::vector<BvhTriangle> soup(std::size_t count, float size, std::uint32_t seed) {
    Random random(seed);
    std::vector<BvhTriangle> triangles;
    for (std::size_t i = 0; i < count; ++i) {
        const vec3 at = random.inCube(1.0F);
        triangles.push_back({at + random.inCube(size), at + random.inCube(size), at + random.inCube(size)});
    }
    return triangles;
}

struct Mesh {
    std::vector<vec3> vertices;
    std::vector<BvhTriangle> triangles;
};

/// A closed sphere; triangles that meet share their vertices bit for bit.
inline Mesh sphere(const vec3& centre, float radius, std::uint32_t rings, std::uint32_t segments) {
    Mesh mesh;
    std::vector<std::vector<vec3>> rows(rings + 1);
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        const float theta = kPi * static_cast<float>(ring) / static_cast<float>(rings);
        const bool pole = ring == 0 || ring == rings;
        for (std::uint32_t segment = 0; segment < segments; ++segment) {
            const float phi = 2.0F * kPi * static_cast<float>(segment) / static_cast<float>(segments);
            const float around = pole ? 0.0F : std::sin(theta);
            rows[ring].push_back(
                centre + radius * vec3(around * std::cos(phi), std::cos(theta), around * std::sin(phi)));
        }
        mesh.vertices.insert(mesh.vertices.end(), rows[ring].begin(),
                             pole ? rows[ring].begin() + 1 : rows[ring].end());
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t segment = 0; segment < segments; ++segment) {
            const std::uint32_t next = (segment + 1) % segments;
            if (ring > 0) {
                mesh.triangles.push_back({rows[ring][segment], rows[ring][next], rows[ring + 1][segment]});
            }
            if (ring + 1 < rings) {
                mesh.triangles.push_back({rows[ring][next], rows[ring + 1][next], rows[ring + 1][segment]});
            }
        }
    }
    return mesh;
}

}  // namespace licht::test
