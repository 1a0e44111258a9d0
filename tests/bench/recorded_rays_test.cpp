// The rays that are measured are those of the renderer, and what is measured is the search for their hits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "licht/core/error.h"
#include "licht/gpu/lanes.h"
#include "licht/on_device/flat_geometry.h"
#include "licht/on_device/gpu_bvh.h"
#include "licht/probe/ray_recorder.h"
#include "licht/probe/ray_tracer.h"
#include "licht/shared/index.h"
#include "samples/scenes/builtin.h"
#include "support/gpu_test.h"

namespace licht {
namespace {

constexpr uvec2 kSize{84, 51};  // no multiple of a tile

Ray rayOf(const RayRecord& r) {
    return {r.origin, r.direction, r.t_min, r.t_max};
}

/// A scene on the device, as the benchmark has it.
struct Recorded {
    explicit Recorded(const char* name) : scene(makeBuiltinScene(name, 2'000).value()) {
        const std::vector<uint> no_lights(scene.instances.size(), kNoIndex);
        const InstanceOrder order = orderInstances(scene, Effects{});
        triangles = worldTriangles(flattenGeometry(scene, Effects{}, order, no_lights));
        const Bvh bvh = buildBvh(triangles);
        on_device =
            GpuBvh(gpu::testDevice(), bvh.nodes, triangleTexels(bvh, triangles), bvh.max_stack, false);
        const Effects effects = detectEffects(scene);
        const GpuScene drawn(gpu::testDevice(), scene, effects, {});
        lists = recordRays(gpu::testDevice(), drawn, scene.cameras.at(0), kSize);
    }
    [[nodiscard]] const std::vector<RayRecord>& rays(std::string_view kind) const {
        return std::find_if(lists.begin(), lists.end(),
                            [&](const RayList& list) { return list.kind == kind; })
            ->rays;
    }

    Scene scene;
    std::vector<BvhTriangle> triangles;
    GpuBvh on_device;
    std::vector<RayList> lists;
};

class RecordedRays : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, RecordedRays, testing::Values("terrain", "spheres"),
                         [](const auto& scene) { return scene.param; });

void expectHits(const Recorded& recorded, const RayList& list, uint rays_per_thread) {
    RayTracer tracer(gpu::testDevice(), recorded.on_device, list.rays, list.any_hit, rays_per_thread);
    EXPECT_GT(tracer.trace(), 0.0);
    EXPECT_GT(tracer.trace(), 0.0);
    const std::vector<RayHitRecord> found = tracer.hits();
    ASSERT_EQ(found.size(), list.rays.size());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < list.rays.size(); ++i) {
        const auto expected = intersectBruteForce(recorded.triangles, rayOf(list.rays[i]));
        ASSERT_EQ(found[i].triangle != kNoIndex, expected.has_value()) << list.kind << i;
        if (!expected) continue;
        ++hits;
        if (list.any_hit) continue;
        EXPECT_EQ(found[i].triangle, expected->triangle) << list.kind << i;
        EXPECT_EQ(found[i].t, expected->t) << list.kind << i;
    }
    EXPECT_GT(hits, 5U) << list.kind;
    if (list.kind != "primary") {
        EXPECT_LT(hits, list.rays.size()) << list.kind;
    }
}

TEST_P(RecordedRays, HitWhatTestingEveryTriangleHits) {
    const Recorded recorded(GetParam());
    for (const RayList& list : recorded.lists) {
        expectHits(recorded, list, 1);
        if (hasBallots(gpu::testDevice())) expectHits(recorded, list, 4);
    }
}

TEST_P(RecordedRays, AreInTheOrderOfTilesAndEachLeavesTheHitBefore) {
    const Recorded recorded(GetParam());
    const Camera& camera = recorded.scene.cameras.at(0);
    const std::vector<RayRecord>& primary = recorded.rays("primary");
    ASSERT_EQ(primary.size(), kSize.x * kSize.y);

    // Pixels of the first row of the first tile, then its second row; then, behind the tile, its neighbour.
    const float pixel =
        2.0F * std::tan(0.5F * camera.y_fov) / static_cast<float>(kSize.y);  // at a distance of one
    const mat3 view_from_world = glm::transpose(mat3(camera.world_from_view));
    const auto column = [&](std::size_t i) {
        const vec3 d = view_from_world * primary[i].direction;
        return static_cast<int>(std::floor(d.x / -d.z / pixel + 0.5F * static_cast<float>(kSize.x)));
    };
    const auto row = [&](std::size_t i) {
        const vec3 d = view_from_world * primary[i].direction;
        return static_cast<int>(std::floor(-d.y / -d.z / pixel + 0.5F * static_cast<float>(kSize.y)));
    };
    for (std::size_t i = 0; i < 128; ++i) {
        EXPECT_EQ(column(i), static_cast<int>(i % 8 + i / 64 * 8)) << i;
        EXPECT_EQ(row(i), static_cast<int>(i % 64 / 8)) << i;
    }

    // Along their list, bounces leave hits of the list before, in order, and none is left out twice. A first
    // hit is the rasteriser's and lies within half a pixel of its ray; a second one is the traversal's own,
    // moved off its plane by kPositionUnits = 2^-19 of its coordinates and edges, which rounding at most
    // doubles.
    float reach = 0.0F;
    for (const BvhTriangle& t : recorded.triangles)
        for (const vec3& v : {t.v0, t.v1, t.v2})
            reach = std::max({reach, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    const float moved =
        2.0F * 0x1p-19F * (3.0F + 4.0F) * reach;  // three coordinates; an edge is at most 2 sqrt(3) of one
    const auto follow = [&](std::string_view from, std::string_view to, bool raster) {
        const std::vector<RayRecord>& before = recorded.rays(from);
        std::size_t at = 0;
        for (const RayRecord& ray : recorded.rays(to)) {
            for (; at < before.size(); ++at) {
                const float along = glm::dot(ray.origin - before[at].origin, before[at].direction);
                const vec3 nearest = before[at].origin + along * before[at].direction;
                float allowed = moved + (raster ? 0.5F * pixel * along : 0.0F);
                if (along > 0.0F && glm::distance(nearest, ray.origin) <= allowed) break;
            }
            ASSERT_LT(at, before.size()) << to << " does not follow " << from;
            ++at;
        }
    };
    follow("primary", "bounce1", true);
    follow("primary", "glossy", true);
    follow("bounce1", "bounce2", false);
    EXPECT_GT(recorded.rays("bounce1").size(), recorded.rays("bounce2").size());
}

TEST(RecordedRaysLimit, APictureWithTooManyRaysIsRefused) {
    const Scene scene = makeBuiltinScene("terrain", 2'000).value();
    const Effects effects = detectEffects(scene);
    const GpuScene on_device(gpu::testDevice(), scene, effects, {});
    EXPECT_THROW(recordRays(gpu::testDevice(), on_device, scene.cameras.at(0), {16384, 8192}), InputError);
}

}  // namespace
}  // namespace licht
