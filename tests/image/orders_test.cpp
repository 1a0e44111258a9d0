// The Neumann series term by term: every order's picture against its closed form, their sum against the
// beauty picture, and what is said of the orders beyond.
#include "licht/film/orders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "licht/core/error.h"
#include "licht/render/renderer.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin.h"
#include "samples/scenes/shapes.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

RenderSettings withOrders(uvec2 size, std::uint32_t bounces) {
    RenderSettings settings;
    settings.size = size;
    settings.bounces = bounces;
    settings.roulette_start = bounces;
    settings.orders = true;
    return settings;
}

bool identical(const Image& a, const Image& b) {
    return a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

void expectEverywhere(const Image& order, double exact, double tolerance, const std::string& what) {
    for (const float value : order.texels)
        ASSERT_NEAR(static_cast<double>(value), exact, tolerance * exact) << what;
}

Scene furnace(float albedo) {
    Scene scene = *makeBuiltinScene("furnace");
    scene.materials[0].base_color = vec4(vec3(albedo), 1.0F);
    return scene;
}

/// Batches whose orders have these energies.
std::vector<LightBatch> batchesOf(const std::vector<std::vector<double>>& energies) {
    std::vector<LightBatch> batches;
    for (const std::vector<double>& of_batch : energies) {
        LightBatch batch;
        batch.samples = 4;
        for (const double e : of_batch) batch.orders.emplace_back(e);
        batches.push_back(batch);
    }
    return batches;
}

// T^i Le = Le r^i in every pixel and without noise. Each bounce rounds the throughput twice and each sample
// is added once: 2 i + 8 roundings of 6e-8.
TEST(Orders, OfAFurnaceAreAGeometricSeriesFreeOfNoise) {
    const Scene scene = furnace(0.7F);
    for (const bool queues : {false, true}) {
        RenderSettings settings = withOrders(uvec2(24, 16), 12);
        settings.queues = queues;
        const Film film = renderFilm(scene, scene.cameras[0], settings, 4);
        ASSERT_EQ(film.orders.size(), 13U);
        for (std::uint32_t i = 0; i <= 12; ++i)
            expectEverywhere(film.orders[i], 0.5 * std::pow(0.7, i), (2 * i + 8) * 6e-8,
                             "order " + std::to_string(i));
    }
}

// Tiles stand in rows and columns: 4096 pixels fit a device's images at most eight times side by side. A few
// paths leave the room along its edges (Furnace.EveryBounceCount...) and bring no more: 1.2e-5 of the rays
// that start evenly spread over the walls, and these begin on a line.
TEST(Orders, OfAWidePictureStandInSeveralRows) {
    const Scene scene = furnace(0.5F);
    Camera camera = scene.cameras[0];
    camera.y_fov = 1e-3F;
    const Film film = renderFilm(scene, camera, withOrders(uvec2(4096, 3), 9), 1);
    ASSERT_EQ(film.orders.size(), 10U);
    const std::size_t pixels = std::size_t{4096} * 3;
    int left = 0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        bool inside = true;
        for (std::size_t i = 0; i <= 9; ++i) {
            const auto value = static_cast<double>(film.orders[i].texels[3 * pixel]);
            inside = inside && (i == 0 || value > 0.0);
            const double exact = inside ? std::pow(0.5, static_cast<double>(i) + 1.0) : 0.0;
            ASSERT_NEAR(value, exact, 1e-6 * exact) << "order " << i << ", pixel " << pixel;
        }
        if (!inside) ++left;
    }
    EXPECT_LE(left, poissonQuantile(10.0 * 1.2e-5 * 9.0 * static_cast<double>(pixels), 1e-9));
}

// A path that roulette keeps is worth what those are that it ended, however few are kept: with albedo 0.02
// one of fifty goes on. Each sample of an order is r^i over what kept it, or nothing.
TEST(Orders, AreKeptWholeByRouletteOnDarkSurfaces) {
    const float albedo = 0.02F;
    const Scene scene = furnace(albedo);
    RenderSettings settings = withOrders(uvec2(64), 2);
    settings.roulette_start = 0;
    const std::uint32_t samples = 64;
    const Film film = renderFilm(scene, scene.cameras[0], settings, samples);
    for (std::size_t i = 1; i <= 2; ++i) {
        double sum = 0.0;
        for (std::size_t k = 0; k < film.orders[i].texels.size(); k += 3)
            sum += static_cast<double>(film.orders[i].texels[k]);
        const double paths = 64.0 * 64.0 * samples;
        const double kept = std::pow(static_cast<double>(albedo), static_cast<double>(i));
        const double mean = sum / (64.0 * 64.0);
        EXPECT_NEAR(mean, 0.5 * kept, 4.5 * 0.5 * std::sqrt(kept / paths)) << "order " << i;
    }
}

// At most eight samples are summed in fp32 before they are taken over in double precision, and a sample adds
// up to two terms: 16 roundings each way.
TEST(Orders, SumToThePicture) {
    const Scene scene = *makeBuiltinScene("cornell");
    const Film film = renderFilm(scene, scene.cameras[0], withOrders(uvec2(40, 32), 6), 20);
    for (std::size_t pixel = 0; pixel < 40 * 32; ++pixel) {
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = 0.0;
            for (const Image& order : film.orders) sum += static_cast<double>(order.texels[3 * pixel + c]);
            const auto mean = static_cast<double>(film.mean.texels[4 * pixel + c]);
            ASSERT_NEAR(sum, mean, 32 * 6e-8 * mean) << "pixel " << pixel;
        }
    }
}

TEST(Orders, AreTheSameInKernelAndQueuesAndChangeNothing) {
    for (const char* name : {"cornell", "gallery"}) {
        const Scene scene = *makeBuiltinScene(name);
        RenderSettings plain = withOrders(uvec2(40, 24), 5);
        RenderSettings queues = plain;
        queues.queues = true;
        const Film kernel_film = renderFilm(scene, scene.cameras[0], plain, 3);
        const Film queue_film = renderFilm(scene, scene.cameras[0], queues, 3);
        ASSERT_EQ(kernel_film.orders.size(), queue_film.orders.size());
        for (std::size_t i = 0; i < kernel_film.orders.size(); ++i)
            EXPECT_TRUE(identical(kernel_film.orders[i], queue_film.orders[i])) << name << ", order " << i;
        plain.orders = false;
        const Film without = renderFilm(scene, scene.cameras[0], plain, 3);
        EXPECT_TRUE(without.orders.empty());
        EXPECT_TRUE(identical(kernel_film.mean, without.mean)) << name;
        EXPECT_TRUE(identical(kernel_film.variance, without.variance)) << name;
    }
}

TEST(Orders, RaysOfAllOrdersAreAllRays) {
    const Scene scene = *makeBuiltinScene("cornell");
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], withOrders(uvec2(32, 32), 4));
    for (int i = 0; i < 5; ++i) renderer.renderSample();
    static_cast<void>(renderer.readFilm());
    const RenderStatistics statistics = renderer.statistics();
    std::uint64_t rays = 0;
    for (const std::uint64_t of_order : statistics.order_rays) rays += of_order;
    EXPECT_EQ(rays, statistics.bounce_rays + statistics.shadow_rays);
    EXPECT_EQ(statistics.order_rays[0], 0U) << "the rasteriser's are counted apart";
}

TEST(Orders, StartAnewWithTheCamera) {
    const Scene scene = *makeBuiltinScene("cornell");
    const RenderSettings settings = withOrders(uvec2(24, 24), 2);
    Renderer renderer(gpu::testDevice(), scene, scene.cameras[0], settings);
    Camera moved = scene.cameras[0];
    moved.world_from_view[3].x += 0.1F;
    renderer.setCamera(moved);
    for (int i = 0; i < 2; ++i) renderer.renderSample();
    renderer.setCamera(scene.cameras[0]);
    for (int i = 0; i < 3; ++i) renderer.renderSample();
    const Film fresh = renderFilm(scene, scene.cameras[0], settings, 3);
    const Film film = renderer.readFilm();
    for (std::size_t i = 0; i < fresh.orders.size(); ++i)
        EXPECT_TRUE(identical(film.orders[i], fresh.orders[i])) << i;
}

TEST(Orders, OfMoreThanTheDeviceHoldsAreRefused) {
    const Scene scene = furnace(0.5F);
    try {
        renderFilm(scene, scene.cameras[0], withOrders(uvec2(1024, 1024), 60'000), 1);
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("60001 layers"), std::string::npos) << error.what();
    }
}

// Two plates, emission E and albedo r: plate 1 shows E1, r1 E2, r1 r2 E1, r1 r2 r1 E2, ... with the sum
// (E1 + r1 E2) / (1 - r1 r2). Of half width W and a metre apart they lose the share 1 / W^2 a bounce at the
// middle.
TEST(Orders, OfTwoPlatesAreTheirAlternatingSeries) {
    constexpr float kHalf = 1000.0F;
    constexpr double kE1 = 0.5, kE2 = 2.0, kR1 = 0.6, kR2 = 0.8;
    Scene scene;
    scene.materials = {lambert(0.6F, 0.5F), lambert(0.8F, 2.0F)};
    const vec3 a(-kHalf, 0, kHalf), b(kHalf, 0, kHalf), c(kHalf, 0, -kHalf), d(-kHalf, 0, -kHalf);
    const vec3 up(0, 1, 0);
    place(scene, quadMesh("plate 1", 0, a, b, c, d));
    place(scene, quadMesh("plate 2", 1, d + up, c + up, b + up, a + up));
    const Film film = renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 3.0F), withOrders(uvec2(16), 30), 2);
    double exact = 0.0;
    for (std::uint32_t i = 0; i <= 30; ++i) {
        const double factor = std::pow(kR1 * kR2, i / 2);
        const double order = i % 2 == 0 ? factor * kE1 : factor * kR1 * kE2;
        // Each bounce loses 1e-6 and rounds twice.
        expectEverywhere(film.orders[i], order, (i + 1) * 1.2e-6, "order " + std::to_string(i));
        exact += order;
    }
    EXPECT_NEAR(static_cast<double>(film.mean.at(8, 8, 0)), exact, 1e-4 * exact);
    EXPECT_NEAR(exact, (kE1 + kR1 * kE2) / (1.0 - kR1 * kR2), 1e-4);
}

// The wall of a sphere with a port of area share f, under a point light in its middle: direct light shows
// r I / (pi R^2), and each bounce leaves the share r (1 - f) of it, because every point of a sphere's inside
// sees every part of it by its area alone: the integrating sphere's multiplier M = r / (1 - r (1 - f)). The
// facets of 128 x 64 are chords of half a diagonal of 0.035 radians: distances are short by at most 6e-4,
// cosines too.
class IntegratingSphere : public testing::TestWithParam<int> {};

TEST_P(IntegratingSphere, MultipliesItsLight) {
    constexpr float kAlbedo = 0.8F, kRadius = 2.0F, kIntensity = 5.0F;
    constexpr std::uint32_t kRings = 64;
    const int port_rings = GetParam();
    const double edge = std::numbers::pi * port_rings / kRings;  // angle from the pole
    const double port = 0.5 * (1.0 - std::cos(edge));
    Scene scene;
    scene.materials = {lambert(kAlbedo)};
    scene.materials[0].double_sided = true;
    Mesh sphere = sphereMesh("sphere", 0, kRadius, 2 * kRings, kRings);
    sphere.normals.clear();
    std::erase_if(sphere.triangles, [&](const uvec3& t) {
        const vec3 middle = (sphere.positions[t.x] + sphere.positions[t.y] + sphere.positions[t.z]) / 3.0F;
        return port_rings > 0 &&
               static_cast<double>(middle.y) > static_cast<double>(kRadius) * std::cos(edge);
    });
    place(scene, std::move(sphere));
    PunctualLight light;
    light.intensity = vec3(kIntensity);
    scene.lights.push_back(light);
    const Camera camera = lookingCamera("inside", vec3(0.2F, 0.1F, 0.3F), vec3(0.0F, -1.5F, -1.0F), 0.9F);
    const Film film = renderFilm(scene, camera, withOrders(uvec2(32), 40), 32);
    const double direct = static_cast<double>(kAlbedo) * static_cast<double>(kIntensity) /
                          (std::numbers::pi * static_cast<double>(kRadius * kRadius));
    const double step = static_cast<double>(kAlbedo) * (1.0 - port);
    constexpr double kFacets = 2e-3;
    for (std::size_t i = 0; i <= 3; ++i) {
        double mean = 0.0;
        for (const float value : film.orders[i].texels) mean += static_cast<double>(value);
        mean /= static_cast<double>(film.orders[i].texels.size());
        const double exact = i == 0 ? 0.0 : direct * std::pow(step, static_cast<double>(i) - 1.0);
        // 32,768 paths, each of which goes on or leaves by the port: a share of the variance p (1 - p).
        const double noise = 4.5 * exact * std::sqrt(static_cast<double>(i) * port / 32768.0);
        EXPECT_NEAR(mean, exact, kFacets * exact + noise) << "order " << i;
    }
    const PictureMean picture = pictureMean(film, 1);
    const double multiplied = direct / (1.0 - step);
    EXPECT_NEAR(picture.mean, multiplied,
                kFacets * multiplied + 4.5 * picture.standard_error + multiplied * std::pow(step, 40));
}

INSTANTIATE_TEST_SUITE_P(Ports, IntegratingSphere, testing::Values(0, 12));

// The tail of a geometric series is itself one: share r^(n+1), at every depth that was followed.
TEST(Series, TailOfAGeometricSeriesIsExact) {
    std::vector<double> energy;
    for (int i = 0; i <= 10; ++i) energy.push_back(3.0 * std::pow(0.8, i));
    const std::vector<LightBatch> batches = batchesOf({energy, energy, energy});
    for (std::uint32_t depth = 0; depth <= 10; ++depth) {
        const std::optional<TailEstimate> tail = estimateTail(batches, depth);
        ASSERT_TRUE(tail);
        EXPECT_NEAR(tail->share.value, std::pow(0.8, depth + 1.0), 1e-6);
        EXPECT_NEAR(tail->lowest, tail->highest, 1e-5);
        EXPECT_NEAR(tail->ratio, 0.8, 1e-6);
        EXPECT_NEAR(tail->share.standard_error, 0.0, 1e-6);
    }
}

TEST(Series, TailThatIsNotGeometricYetHasALowestAndAHighest) {
    const std::vector<LightBatch> batches = batchesOf({{8.0, 4.0, 2.0, 0.8, 0.4}});
    const std::optional<TailEstimate> tail = estimateTail(batches, 4);
    ASSERT_TRUE(tail);
    EXPECT_LT(tail->lowest, tail->share.value);
    EXPECT_GT(tail->highest, tail->share.value);
    EXPECT_LT(tail->share.standard_error, 0.0) << "one batch knows no error";
    EXPECT_NEAR(tail->ratio, std::cbrt(0.4 / 4.0), 1e-6);
}

TEST(Series, WithoutALimitTheTailIsEverything) {
    const std::vector<LightBatch> batches = batchesOf({{1.0, 1.0, 1.0, 1.0}});
    EXPECT_EQ(estimateTail(batches, 3)->share.value, 1.0);
    EXPECT_FALSE(depthFor(batches, 0.5));
}

TEST(Series, DarknessHasNoTail) {
    EXPECT_FALSE(estimateTail(batchesOf({{0.0, 0.0, 0.0}}), 2));
    EXPECT_EQ(depthFor(batchesOf({{0.0, 0.0, 0.0}}), 0.01), 0U);
    EXPECT_FALSE(estimateTail(batchesOf({{1.0}}), 0)) << "one order has no ratio";
    EXPECT_EQ(estimateTail(batchesOf({{1.0, 0.5, 0.0, 0.0}}), 1)->share.value, 0.0) << "light that ends";
}

// Bounces until one per cent is left: 6 at albedo 0.5, 20 at 0.8, 43 at 0.9.
TEST(Series, DepthIsWhereTheTailFallsBelowTheError) {
    const std::vector<std::pair<double, std::uint32_t>> known{{0.5, 6}, {0.8, 20}, {0.9, 43}};
    for (const auto& [albedo, depth] : known) {
        std::vector<double> energy;
        for (int i = 0; i <= 64; ++i) energy.push_back(std::pow(albedo, i));
        EXPECT_EQ(depthFor(batchesOf({energy, energy}), 0.01), depth) << albedo;
    }
}

// Shares of equal batches with known spread: the jackknife of a mean is its standard error.
TEST(Series, StandardErrorIsThatOfTheBatches) {
    const std::vector<LightBatch> batches = batchesOf({{1.0}, {3.0}, {2.0}, {2.0}});
    const std::vector<LightBatch> reference = batchesOf({{1.0}, {1.0}, {1.0}, {1.0}});
    const Estimated change = relativeDifference(batches, reference);
    EXPECT_NEAR(change.value, 1.0, 1e-6);
    EXPECT_NEAR(change.standard_error, std::sqrt(2.0 / 3.0 / 4.0), 1e-6);
}

}  // namespace
}  // namespace licht
