// Warps of uniform numbers on the device, against the distributions that they promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "histogram.h"
#include "kernel.h"
#include "licht/core/math.h"
#include "licht/shared/seam.h"
#include "licht/spirv/sampling_comp.h"

namespace licht {
namespace {

using glm::uvec4;
using test::Histogram;

constexpr double kPi = std::numbers::pi;
constexpr double kUnit = 0x1p-24;  // relative error of one fp32 rounding
constexpr std::uint32_t kCount = 1U << 20U;
constexpr std::size_t kSide = 32;
constexpr int kTests = 10;  // chi-square tests in this file: one a shape

enum Shape : std::uint32_t {
    kDisc = 1,
    kCosine,
    kSphere,
    kTriangle,
    kCircle,
    kHemisphere,
    kBall,
    kRejectedDisc,
    kRejectedBall,
    kRejectedHemisphere,
    kRejectedCosine
};

struct Push {
    std::uint32_t count;
    std::uint32_t shape;
    std::uint32_t seed;
};

class Warps : public testing::Test {
protected:
    std::vector<vec4> draw(Shape shape) {
        return kernel_.run<vec4>(kCount, kCount, Push{kCount, shape, 5}, std::vector<uvec4>{uvec4(0U)});
    }

private:
    test::Kernel kernel_{"sampling", sampling_comp};
};
using Rejection = Warps;

double d(float x) {
    return static_cast<double>(x);
}

double turn(double x, double y) {
    const double angle = std::atan2(y, x) / (2.0 * kPi);
    return angle < 0.0 ? angle + 1.0 : angle;
}

class Discs : public Warps, public testing::WithParamInterface<Shape> {};

TEST_P(Discs, areUniform) {
    Histogram cells(kSide, kSide);
    for (const vec4& p : draw(GetParam())) {
        const double r2 = d(p.x) * d(p.x) + d(p.y) * d(p.y);
        ASSERT_LE(r2, 1.0 + 8.0 * kUnit);
        cells.add(turn(d(p.x), d(p.y)), r2);  // equal rings have equal steps of r^2
    }
    test::expectLikely("disc", cells.counts(), cells.uniform(), kTests);
}

INSTANTIATE_TEST_SUITE_P(Both, Discs, testing::Values(kDisc, kRejectedDisc));

class CosineHemispheres : public Warps, public testing::WithParamInterface<Shape> {};

TEST_P(CosineHemispheres, followTheCosine) {
    Histogram cells(kSide, kSide);
    for (const vec4& w : draw(GetParam())) {
        ASSERT_GE(w.z, 0.0F);
        // Squares of length differ from one by the roundings of three components, 2 u of length.
        ASSERT_NEAR(d(w.x) * d(w.x) + d(w.y) * d(w.y) + d(w.z) * d(w.z), 1.0, 8.0 * kUnit);
        if (GetParam() == kCosine) {
            ASSERT_NEAR(d(w.w), d(w.z) / kPi, 2.0 * kUnit);
        }
        cells.add(turn(d(w.x), d(w.y)), d(w.z) * d(w.z));  // cos / pi integrates to equal steps of cos^2
    }
    test::expectLikely("cosine", cells.counts(), cells.uniform(), kTests);
}

INSTANTIATE_TEST_SUITE_P(Both, CosineHemispheres, testing::Values(kCosine, kRejectedCosine));

TEST_F(Warps, uniformSphere) {
    Histogram cells(kSide, kSide);
    for (const vec4& w : draw(kSphere)) {
        ASSERT_NEAR(d(w.x) * d(w.x) + d(w.y) * d(w.y) + d(w.z) * d(w.z), 1.0, 8.0 * kUnit);
        cells.add(turn(d(w.x), d(w.y)), 0.5 - 0.5 * d(w.z));  // Archimedes: equal steps of z
    }
    test::expectLikely("sphere", cells.counts(), cells.uniform(), kTests);
}

class Hemispheres : public Warps, public testing::WithParamInterface<Shape> {};

TEST_P(Hemispheres, areUniform) {
    Histogram cells(kSide, kSide);
    for (const vec4& w : draw(GetParam())) {
        ASSERT_GE(w.z, 0.0F);
        ASSERT_NEAR(d(w.x) * d(w.x) + d(w.y) * d(w.y) + d(w.z) * d(w.z), 1.0, 10.0 * kUnit);
        cells.add(turn(d(w.x), d(w.y)), d(w.z));
    }
    test::expectLikely("hemisphere", cells.counts(), cells.uniform(), kTests);
}

INSTANTIATE_TEST_SUITE_P(Both, Hemispheres, testing::Values(kHemisphere, kRejectedHemisphere));

class Balls : public Warps, public testing::WithParamInterface<Shape> {};

TEST_P(Balls, areUniform) {
    constexpr std::size_t kCells = 16;  // of radius, height and angle each
    std::vector<std::uint64_t> counts(kCells * kCells * kCells);
    for (const vec4& p : draw(GetParam())) {
        const double r = std::sqrt(d(p.x) * d(p.x) + d(p.y) * d(p.y) + d(p.z) * d(p.z));
        ASSERT_LE(r, 1.0 + 8.0 * kUnit);
        const auto cell = [](double share) {
            return static_cast<std::size_t>(std::clamp(share * kCells, 0.0, kCells - 1.0));
        };
        // Equal shells have equal steps of r^3.
        const std::size_t shell = cell(r * r * r);
        ++counts[(shell * kCells + cell(0.5 + 0.5 * d(p.z) / r)) * kCells + cell(turn(d(p.x), d(p.y)))];
    }
    test::expectLikely(
        "ball", counts,
        std::vector<double>(counts.size(), double{kCount} / static_cast<double>(counts.size())), kTests);
}

INSTANTIATE_TEST_SUITE_P(Both, Balls, testing::Values(kBall, kRejectedBall));

// A try is accepted with the share that the shape has of the square or cube around it, whatever was before
// it: pi / 4 and pi / 6, so that pi itself comes out.
TEST_F(Rejection, acceptsByTheVolume) {
    for (const Shape shape : {kRejectedDisc, kRejectedCosine, kRejectedBall, kRejectedHemisphere}) {
        const bool plane = shape == kRejectedDisc || shape == kRejectedCosine;
        const double chance = plane ? kPi / 4.0 : kPi / 6.0;
        double tries = 0.0;
        double first = 0.0;
        double second = 0.0;
        for (const vec4& answer : draw(shape)) {
            ASSERT_GE(answer.w, 1.0F);
            ASSERT_LT(answer.w, plane ? 16.0F : 32.0F) << "refused to the last: 2e-5 of all runs have one";
            tries += d(answer.w);
            if (answer.w == 1.0F) ++first;
            if (answer.w == 2.0F) ++second;
        }
        // Of so many tries kCount are accepted.
        EXPECT_NEAR(kCount / tries, chance, 4.0 * std::sqrt(chance * (1.0 - chance) / tries)) << shape;
        const auto expectShare = [](double count, double of, double share, Shape what) {
            EXPECT_NEAR(count / of, share, 4.0 * std::sqrt(share * (1.0 - share) / of)) << what;
        };
        expectShare(first, kCount, chance, shape);
        expectShare(second, kCount - first, chance, shape);
    }
}

TEST_F(Warps, triangle) {
    // Each cell of the unit square is split along b1 + b2, so whole cells and diagonal halves are told apart.
    std::vector<std::uint64_t> counts(kSide * kSide);
    std::vector<double> expected(kSide * kSide);
    constexpr double kCellShare = 2.0 * kCount / (kSide * kSide);  // the triangle has half the square's area
    for (std::size_t y = 0; y < kSide; ++y)
        for (std::size_t x = 0; x < kSide; ++x)
            expected[y * kSide + x] =
                x + y + 1 < kSide ? kCellShare : (x + y + 1 == kSide ? 0.5 * kCellShare : 0.0);
    for (const vec4& b : draw(kTriangle)) {
        ASSERT_TRUE(b.x >= 0.0F && b.y >= 0.0F && d(b.x) + d(b.y) <= 1.0 + kUnit);
        const auto x = static_cast<std::size_t>(d(b.x) * kSide);
        const auto y = static_cast<std::size_t>(d(b.y) * kSide);
        ++counts.at(y * kSide + x);
    }
    test::expectLikely("triangle", counts, expected, kTests);
}

TEST_F(Warps, unitCircle) {
    double worst_length = 0.0;
    double worst_angle = 0.0;
    for (const vec4& p : draw(kCircle)) {
        const double angle = 2.0 * kPi * d(p.z);
        worst_length = std::max(worst_length, std::abs(std::hypot(d(p.x), d(p.y)) - 1.0));
        worst_angle = std::max(worst_angle, std::abs(d(p.y) * std::cos(angle) - d(p.x) * std::sin(angle)));
    }
    RecordProperty("worst_length", std::to_string(worst_length / kUnit));
    RecordProperty("worst_angle", std::to_string(worst_angle / kUnit));
    EXPECT_LE(worst_length, 2e-7);
    // The angle below pi / 4 rounds twice (factor and product), the polynomials' last steps once each: 4 u.
    EXPECT_LE(worst_angle, 4.0 * kUnit);
}

}  // namespace
}  // namespace licht
