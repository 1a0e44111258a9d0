// The traversal on the device finds what testing every triangle on the host finds, bit for bit: the
// operations are the same and lavapipe rounds every one of them correctly. (Vulkan allows a division 2.5 ulp;
// a device that uses this may differ in the last bits.)
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

#include "licht/bvh/bvh.h"
#include "support/gpu_test.h"
#include "support/tracer.h"
#include "unit/bvh_meshes.h"

namespace licht {
namespace {

using test::Lanes;
using test::Mesh;
using test::Random;
using test::soup;
using test::sphere;
using test::Tracer;

std::vector<Ray> randomRays(int count, float half, std::uint32_t seed) {
    Random random(seed);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        rays.push_back({random.inCube(half), random.direction()});
        if (i % 4 == 0) {
            rays.back().t_min = random.uniform(0.0F, 0.5F);
            rays.back().t_max = random.uniform(0.4F, 2.0F);
        }
    }
    return rays;
}

/// Returns how many rays hit.
int expectSameHits(Tracer& tracer, const std::vector<Ray>& rays) {
    const auto found = tracer.trace(rays);
    const auto any = tracer.trace(rays, {0, kInfinity, 0, 0});
    EXPECT_EQ(tracer.truncated(), 0);
    int hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto expected = intersectBruteForce(tracer.triangles(), rays[i]);
        EXPECT_EQ(found[i].has_value(), expected.has_value()) << i;
        EXPECT_EQ(any[i].has_value(), expected.has_value()) << i;
        if (found[i] && expected) {
            ++hits;
            EXPECT_EQ(found[i]->triangle, expected->triangle) << i;
            EXPECT_EQ(found[i]->t, expected->t) << i;
            EXPECT_EQ(found[i]->b1, expected->b1) << i;
            EXPECT_EQ(found[i]->b2, expected->b2) << i;
        }
    }
    return hits;
}

struct Form {
    const char* name;
    bool in_storage;
    Lanes lanes;
};

class Traversal : public testing::TestWithParam<Form> {
protected:
    static Tracer tracerOf(std::vector<BvhTriangle> triangles) {
        return Tracer(std::move(triangles), GetParam().in_storage, GetParam().lanes);
    }
};
INSTANTIATE_TEST_SUITE_P(Forms, Traversal,
                         testing::Values(Form{"texels", false, Lanes::own}, Form{"storage", true, Lanes::own},
                                         Form{"refilled", false, Lanes::refilled}),
                         [](const auto& form) { return form.param.name; });

TEST_P(Traversal, FindsWhatTestingEveryTriangleFinds) {
    Tracer tracer = tracerOf(soup(1'000, 0.2F, 1));
    EXPECT_GT(expectSameHits(tracer, randomRays(4'000, 1.5F, 2)), 1'000);
}

// A hit nearer than is enough ends the traversal, whatever is nearer still; behind that the nearest is
// wanted.
TEST_P(Traversal, AHitThatIsNearEnoughEndsIt) {
    constexpr float kEnough = 0.7F;
    const std::vector<BvhTriangle> triangles = soup(1'000, 0.3F, 1);
    const std::vector<Ray> rays = randomRays(4'000, 1.5F, 2);
    Tracer tracer = tracerOf(triangles);
    const auto found = tracer.trace(rays, {0, kEnough, 0, 0});
    int behind = 0;
    int passed_over = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto nearest = intersectBruteForce(triangles, rays[i]);
        ASSERT_EQ(found[i].has_value(), nearest.has_value()) << i;
        if (!nearest) continue;
        if (nearest->t >= kEnough) {
            ASSERT_EQ(found[i]->triangle, nearest->triangle) << i;
            ++behind;
        } else {
            ASSERT_LT(found[i]->t, kEnough) << i;
            passed_over += found[i]->triangle != nearest->triangle ? 1 : 0;
        }
    }
    EXPECT_GT(behind, 100);
    EXPECT_GT(passed_over, 10);
}

TEST_P(Traversal, SliversSeenEdgeOnAndDuplicatesOnAGrazedFloor) {
    Random random(3);
    std::vector<BvhTriangle> triangles;
    for (int i = 0; i < 500; ++i) {
        const vec3 a = random.inCube(1.0F);
        const vec3 b = random.inCube(1.0F);
        triangles.push_back({a, b, glm::mix(a, b, 0.3F) + random.inCube(std::ldexp(1.0F, -(i % 24)))});
    }
    for (int i = 0; i < 100; ++i) {
        const auto onFloor = [&] { return vec3(random.uniform(-2, 2), -0.3F, random.uniform(-2, 2)); };
        const BvhTriangle floor{onFloor(), onFloor(), onFloor()};
        triangles.insert(triangles.end(), 4, floor);
    }
    std::vector<Ray> rays;
    for (int i = 0; i < 4'000; ++i) {
        const BvhTriangle& triangle = triangles[random.index(triangles.size())];
        const vec3 origin = random.inCube(1.5F);
        rays.push_back({origin, glm::mix(triangle.v0, triangle.v1, random.uniform(0.0F, 1.0F)) - origin});
    }
    Tracer tracer = tracerOf(triangles);
    EXPECT_GT(expectSameHits(tracer, rays), 2'000);
}

TEST_P(Traversal, EveryOrderOfMagnitude) {
    Random random(4);
    std::vector<BvhTriangle> triangles;
    std::vector<Ray> rays;
    for (int i = 0; i < 600; ++i) {
        const float scale = std::ldexp(1.0F, i / 10 - 30);
        const vec3 at = random.inCube(scale);
        triangles.push_back(
            {at + random.inCube(scale), at + random.inCube(scale), at + random.inCube(scale)});
        const vec3 origin = random.inCube(4.0F * scale);
        rays.push_back({origin, (at - origin) * std::ldexp(1.0F, i % 80 - 40)});
    }
    Tracer tracer = tracerOf(triangles);
    EXPECT_GT(expectSameHits(tracer, rays), 300);
}

TEST_P(Traversal, NoRayEscapesAClosedSphere) {
    for (const vec3 centre : {vec3(0.0F), vec3(148376.0F, 1234.0F, -223423.0F)}) {
        const Mesh mesh = sphere(centre, 2.0F, 12, 24);
        Random random(5);
        std::vector<Ray> rays;
        for (int i = 0; i < 50'000; ++i) {
            const vec3 origin = i % 5 == 0 ? centre : centre + random.inCube(1.0F);
            const BvhTriangle& triangle = mesh.triangles[random.index(mesh.triangles.size())];
            const vec3 targets[3] = {triangle.v0, 0.5F * triangle.v0 + 0.5F * triangle.v1,
                                     origin + random.direction()};
            rays.push_back({origin, targets[i % 3] - origin});
        }
        int escaped = 0;
        Tracer tracer = tracerOf(mesh.triangles);
        for (const auto& hit : tracer.trace(rays)) {
            escaped += hit ? 0 : 1;
        }
        EXPECT_EQ(escaped, 0);
        EXPECT_EQ(tracer.truncated(), 0);
    }
}

TEST_P(Traversal, RaysThatAreNotFiniteMiss) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Ray good{{0, 0, 1}, {0, 0, -1}};
    std::vector<Ray> rays;
    for (const float bad : {nan, kInfinity, -kInfinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            rays.insert(rays.end(), 2, good);
            rays[rays.size() - 2].origin[axis] = bad;
            rays.back().direction[axis] = bad;
        }
    }
    rays.push_back({{0, 0, 1}, {0, 0, 0}});
    rays.push_back({{0, 0, 1}, {0, 0, -1}, nan, 2.0F});
    rays.push_back({{0, 0, 1}, {0, 0, -1}, 0.0F, nan});
    rays.push_back({{0, 0, 1}, {0, 0, -1}, 2.0F, 1.0F});
    rays.push_back(good);
    Tracer tracer = tracerOf({{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}});
    EXPECT_EQ(expectSameHits(tracer, rays), 1);
    EXPECT_TRUE(tracer.trace(rays).back());
}

TEST_P(Traversal, RefusedHitsAreWalkedThrough) {
    std::vector<BvhTriangle> triangles = soup(600, 0.3F, 6);
    // Two that span the scene and stay, so that the kept ones alone have the same bounds.
    triangles.push_back({{-2, -2, -2}, {-1.9F, -2, -2}, {-2, -1.9F, -2}});
    triangles.push_back({{2, 2, 2}, {1.9F, 2, 2}, {2, 1.9F, 2}});
    constexpr std::uint32_t kRefused = 3;
    Tracer tracer = tracerOf(triangles);
    std::vector<BvhTriangle> kept = triangles;
    for (std::uint32_t position = 0; position < tracer.bvh().triangle_ids.size(); position += kRefused) {
        const std::uint32_t id = tracer.bvh().triangle_ids[position];
        if (id < 600) {
            kept[id] = {};  // without area
        }
    }
    const auto rays = randomRays(2'000, 1.0F, 7);
    const auto found = tracer.trace(rays, {0, 0, kRefused, 0});
    int changed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto expected = intersectBruteForce(kept, rays[i]);
        const auto unfiltered = intersectBruteForce(triangles, rays[i]);
        ASSERT_EQ(found[i].has_value(), expected.has_value()) << i;
        if (found[i]) {
            EXPECT_EQ(found[i]->triangle, expected->triangle) << i;
            EXPECT_EQ(found[i]->t, expected->t) << i;
            changed += unfiltered->triangle != expected->triangle ? 1 : 0;
        }
    }
    EXPECT_GT(changed, 100);
}

TEST_P(Traversal, AnEmptySceneIsMissed) {
    Tracer tracer = tracerOf({});
    EXPECT_EQ(expectSameHits(tracer, randomRays(100, 1.0F, 8)), 0);
}

// Equal triangles must all be looked at. Each ray accepts one of them alone, from the first to the last
// position, so that a traversal which ends early misses.
int missesAmongEqualTriangles(Tracer& tracer, std::uint32_t stride) {
    const std::vector<Ray> rays(tracer.triangles().size() / stride, Ray{{0.1F, -0.2F, 2.0F}, {0, 0, -1}});
    const auto found = tracer.trace(rays, {0, 0, 0, stride});
    int misses = 0;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
        misses += found[i] ? 0 : 1;
        EXPECT_TRUE(!found[i] || found[i]->triangle == tracer.bvh().triangle_ids[i * stride]);
    }
    return misses;
}

constexpr BvhTriangle kTriangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};

TEST_P(Traversal, LongWalksReachEveryTriangle) {
    // At most one round a triangle and one for each of the nodes, of which there are fewer: below the 65,535
    // rounds that every driver runs. Rays of a share have them together.
    const std::uint32_t sharing = GetParam().lanes == Lanes::refilled ? Tracer::kRefills : 1;
    Tracer tracer = tracerOf(std::vector<BvhTriangle>(32'000 / sharing, kTriangle));
    ASSERT_LT(sharing * (tracer.triangles().size() + tracer.bvh().nodes.size()), 65'535U);
    EXPECT_EQ(missesAmongEqualTriangles(tracer, 500 / sharing), 0);
    EXPECT_EQ(tracer.truncated(), 0);
}

TEST_P(Traversal, NoTraversalIsTruncatedSilently) {
    Tracer tracer = tracerOf(std::vector<BvhTriangle>(320'000, kTriangle));
    const int misses = missesAmongEqualTriangles(tracer, 5'000);
    EXPECT_EQ(misses, tracer.truncated());
    if (tracer.refills()) {
        EXPECT_EQ(misses, tracer.reported());
    }
}

// The least that a device may offer, and lavapipe.
TEST(TraversalMemory, StorageBuffersAreTakenWhereTexelBuffersAreTooSmall) {
    VkPhysicalDeviceLimits limits{};
    limits.maxTexelBufferElements = 65'536;
    limits.maxStorageBufferRange = 1U << 27U;
    EXPECT_TRUE(fitTexelBuffer(65'536 * sizeof(vec4), limits));
    EXPECT_FALSE(fitTexelBuffer(65'537 * sizeof(vec4), limits));
    gpu::Device& device = gpu::testDevice();
    const std::vector<BvhTriangle> triangles = soup(100, 0.2F, 8);
    const Bvh bvh = buildBvh(triangles);
    const auto inStorage = [&](bool asked) {
        return GpuBvh(device, bvh.nodes, triangleTexels(bvh, triangles), bvh.max_stack, asked).inStorage();
    };
    EXPECT_TRUE(inStorage(true));
    EXPECT_EQ(inStorage(false),
              !fitTexelBuffer(triangles.size() * kBvhTexelsPerTriangle * sizeof(vec4), device.limits()));
}

}  // namespace
}  // namespace licht
