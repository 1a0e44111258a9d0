// Closed meshes let no ray out, and a point where many triangles meet is hit once.
// In the suite 1e6 rays a mesh, with LICHT_NIGHTLY=1 1e8.
#include <cmath>
#include <iostream>

#include "hard.h"

namespace licht {
namespace {

using test::Caster;
using test::Hits;
using test::Mesh;
using test::OnBoth;
using test::Random;

/// Rays that start inside and hit nothing, among `count` in batches.
std::size_t escapes(test::Where where, const Mesh& mesh, const vec3& centre, float inside,
                    std::size_t count) {
    Caster caster(mesh.triangles, where);
    Random random(1);
    std::size_t escaped = 0;
    constexpr std::size_t kBatch = 500'000;
    for (std::size_t done = 0; done < count; done += kBatch) {
        const std::vector<Ray> rays = test::raysFromWithin(mesh, centre, inside, kBatch, random);
        escaped += test::missesOf(caster.nearest(rays));
    }
    return escaped;
}

class Watertight : public OnBoth {};

TEST_P(Watertight, NoRayEscapesANoisySphere) {
    const Mesh mesh = test::noisy(test::sphere(vec3(0.0F), 2.0F, 64, 128), vec3(0.0F), 0.05F);
    EXPECT_EQ(escapes(GetParam(), mesh, vec3(0.0F), 0.5F, test::often(1'000'000, 100'000'000)), 0U);
}

// At 223423 an ulp is 1/64: the edges of this sphere are a few ulp long, and vertices fall together.
TEST_P(Watertight, NoRayEscapesASphereWhoseEdgesAreAFewUlp) {
    const vec3 centre(148376.0F, 1234.0F, -223423.0F);
    for (const std::uint32_t segments : {24U, 50U, 100U, 200U}) {
        const Mesh mesh = test::sphere(centre, 2.0F, segments / 2, segments);
        EXPECT_EQ(escapes(GetParam(), mesh, centre, 0.5F, test::often(500'000, 25'000'000)), 0U) << segments;
    }
}

TEST_P(Watertight, TheHubAndTheSpokesOfAClosedFanAreHitOnce) {
    for (const int blades : {4, 16, 64, 256, 1024}) {
        const vec3 hub(0.1F, 0.2F, 0.3F);
        const auto rim = [&](int i) {
            const float angle = 2.0F * kPi * static_cast<float>(i % blades) / static_cast<float>(blades);
            return hub + vec3(std::cos(angle), std::sin(angle), 0.1F * std::sin(3.0F * angle));
        };
        std::vector<BvhTriangle> fan;
        std::vector<Ray> rays;
        const vec3 eye = hub + vec3(0.03F, -0.02F, 3.0F);
        for (int i = 0; i < blades; ++i) {
            fan.push_back({hub, rim(i), rim(i + 1)});
            rays.push_back({eye, hub - eye});
            rays.push_back({eye, glm::mix(hub, rim(i), 0.37F) - eye});
        }
        Caster caster(fan, GetParam());
        const Hits nearest = caster.nearest(rays);
        const Hits any = caster.any(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_TRUE(nearest[i] && any[i]) << blades;
            // A vertex is sheared by at most (2 * 0.5 + 8 * 3) u sideways, u = 2^-24; blades rise by at most
            // 0.32 of that over a length of 3; the distance is rounded six times: less than 16 u.
            EXPECT_NEAR(nearest[i]->t, 1.0F, 16.0F * 0x1p-24F) << blades;
            EXPECT_TRUE(test::same(nearest[i], intersectBruteForce(fan, rays[i]))) << blades;
        }
    }
}

// Edges belong to both their triangles, so that none is missed. A ray that goes through a surface more than
// once (alpha) counts both; this says how often one in general position meets that.
TEST(Edges, RaysThatBothNeighboursCountAreRare) {
    const Mesh mesh = test::sphere(vec3(0.0F), 2.0F, 32, 64);  // convex: one way out
    const Bvh bvh = buildBvh(mesh.triangles);
    Random random(2);
    const std::size_t count = test::often(1'000'000, 20'000'000);
    std::size_t twice = 0;
    for (std::size_t i = 0; i < count; ++i) {
        Ray ray{random.inCube(0.5F), random.direction()};
        const auto first = intersect(bvh, mesh.triangles, ray);
        ASSERT_TRUE(first);
        ray.t_min = first->t;
        // The other triangle at the same distance has the higher index; one behind shows with a later start.
        ray.t_min = std::nextafter(first->t, kInfinity);
        twice += intersect(bvh, mesh.triangles, ray) ? 1U : 0U;
    }
    std::cout << twice << " of " << count << " rays meet both triangles of an edge\n";
    // A crossing lies on an edge of the fp32 grid with a probability of about 2^-24 a triangle's width in
    // units of the coordinates' ulp: with edges of 0.2 in coordinates of 2, a few in 1e6.
    EXPECT_LE(static_cast<double>(twice), 1e-5 * static_cast<double>(count));
}

INSTANTIATE_TEST_SUITE_P(Hard, Watertight, testing::Values(test::Where::host, test::Where::device),
                         test::nameOfWhere);

}  // namespace
}  // namespace licht
