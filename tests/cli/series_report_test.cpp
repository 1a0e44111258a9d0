#include "samples/licht/series_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "licht/render/pass_list.h"

namespace licht {
namespace {

constexpr std::uint32_t kBounces = 3;

RenderReport reportOf(bool queues) {
    RenderReport report;
    report.settings.orders = true;
    report.settings.bounces = kBounces;
    report.settings.queues = queues;
    LightBatch batch;
    batch.samples = 1;
    batch.orders.assign(kBounces + 1, glm::dvec3(1.0));
    report.light = {batch, batch};
    report.statistics.order_rays.assign(kBounces + 1, 1);
    return report;
}

double allSeconds(const RenderReport& report) {
    double seconds = 0.0;
    for (const auto& order : ordersJson(report)) seconds += order.at("seconds").get<double>();
    return seconds;
}

/// The seconds of that pass alone that the orders are said to have taken, of one.
double shareOf(bool queues, const std::string& pass) {
    RenderReport report = reportOf(queues);
    report.statistics.passes[pass] = {1.0, 1};
    return allSeconds(report);
}

TEST(SeriesReport, EveryPassThatLooksForLightIsCountedOnce) {
    EXPECT_DOUBLE_EQ(shareOf(true, passName(PassId::gbuffer)), 1.0);
    EXPECT_DOUBLE_EQ(shareOf(true, passName(PassId::path_start)), 1.0);
    for (std::uint32_t bounce = 0; bounce < kBounces; ++bounce) {
        for (const PassId kernel : {PassId::path_shade, PassId::path_shadow, PassId::path_trace})
            EXPECT_DOUBLE_EQ(shareOf(true, passName(kernel, bounce)), 1.0) << passName(kernel, bounce);
    }
    EXPECT_DOUBLE_EQ(shareOf(true, passName(PassId::path_shade, kBounces)), 1.0);
    EXPECT_DOUBLE_EQ(shareOf(true, passName(PassId::tonemap)), 0.0);
}

TEST(SeriesReport, OneKernelIsSharedOutByRays) {
    EXPECT_DOUBLE_EQ(shareOf(false, passName(PassId::gbuffer)), 1.0);
    // Rays of order 0 are the rasteriser's.
    EXPECT_DOUBLE_EQ(shareOf(false, passName(PassId::path)), kBounces / (kBounces + 1.0));
}

}  // namespace
}  // namespace licht
