// Rays that are not finite hit nothing and cost no more than 2.5 ordinary ones.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>

#include "hard.h"

namespace licht {
namespace {

using test::Random;

/// What the rays take: seconds of the processor on the host, of the device on the device. The least of seven
/// runs, so that what else runs on the machine counts little.
template <typename Trace>
double leastSeconds(const Trace& trace) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 7; ++run) {
        least = std::min(least, trace());
    }
    return least;
}

std::vector<Ray> spoilt(std::vector<Ray> rays, float bad) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto axis = static_cast<glm::length_t>(i / 2 % 3);
        (i % 2 == 0 ? rays[i].origin : rays[i].direction)[axis] = bad;
    }
    return rays;
}

class BadRays : public test::OnBoth {};

TEST_P(BadRays, MissInAtMostTwoAndAHalfTimesTheTime) {
    const std::vector<BvhTriangle> triangles = test::soup(20'000, 0.05F, 1);
    Random random(2);
    std::vector<Ray> good;
    for (int i = 0; i < 100'000; ++i) {
        good.push_back({random.inCube(1.0F), random.direction()});
    }
    const bool on_device = GetParam() == test::Where::device;
    const Bvh bvh = buildBvh(triangles);
    std::unique_ptr<test::Tracer> tracer = on_device ? std::make_unique<test::Tracer>(triangles) : nullptr;
    std::size_t hits = 0;
    const auto run = [&](const std::vector<Ray>& rays) {
        hits = 0;
        if (tracer) {
            const double before = tracer->deviceSeconds();
            hits = rays.size() - test::missesOf(tracer->trace(rays));
            return tracer->deviceSeconds() - before;
        }
        const auto start = std::chrono::steady_clock::now();
        for (const Ray& ray : rays) {
            hits += intersect(bvh, triangles, ray) ? 1U : 0U;
        }
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const double ordinary = leastSeconds([&] { return run(good); });
    EXPECT_GT(hits, good.size() / 10);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity}) {
        const std::vector<Ray> rays = spoilt(good, bad);
        const double seconds = leastSeconds([&] { return run(rays); });
        EXPECT_EQ(hits, 0U) << bad;
        std::cout << bad << ": " << seconds / ordinary << " of an ordinary ray's time\n";
        if (ordinary > 0.0) {  // a queue without timestamps says 0
            EXPECT_LE(seconds, 2.5 * ordinary) << bad;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Hard, BadRays, testing::Values(test::Where::host, test::Where::device),
                         test::nameOfWhere);

}  // namespace
}  // namespace licht
