// The uniform numbers of the device and their warps, against the distributions that they promise.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
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
// Chi-square tests in this file: 4 ways to vary times (4 channels + 6 pairs), 2 neighbours times 4 channels,
// 3 pairs across samples, dimensions and seeds times 4 channels, 4 shapes.
constexpr int kTests = 4 * 10 + 2 * 4 + 3 * 4 + 4;

enum Shape : std::uint32_t { kNumbers, kDisc, kCosine, kSphere, kTriangle, kCircle, kWords };
enum Varies : std::uint32_t { kPixel, kIndex, kDimension, kSeed };

struct Push {
    std::uint32_t count = kCount;
    std::uint32_t shape = kNumbers;
    std::uint32_t index = 3;
    std::uint32_t dimension = 1;
    std::uint32_t seed = 5;
    std::uint32_t varies = kPixel;
};

class Sampling : public testing::Test {
protected:
    std::vector<vec4> draw(const Push& push, const std::vector<uvec4>& words = {uvec4(0U)}) {
        return kernel_.run<vec4>(push.count, push.count, push, words);
    }

private:
    test::Kernel kernel_{"sampling", sampling_comp};
};
using Random = Sampling;
using Warps = Sampling;

Push shape(Shape s) {
    Push push;
    push.shape = s;
    return push;
}

Push varying(Varies v) {
    Push push;
    push.varies = v;
    return push;
}

double d(float x) {
    return static_cast<double>(x);
}

TEST_F(Random, everyChannelAndPairIsUniform) {
    for (const Varies varies : {kPixel, kIndex, kDimension, kSeed}) {
        const std::vector<vec4> numbers = draw(varying(varies));
        for (int a = 0; a < 4; ++a) {
            Histogram line(kSide * kSide, 1);
            for (const vec4& u : numbers) {
                ASSERT_TRUE(u[a] >= 0.0F && u[a] < 1.0F);
                line.add(d(u[a]), 0.0);
            }
            const std::string name = std::to_string(varies) + " channel " + std::to_string(a);
            test::expectLikely(name, line.counts(), line.uniform(), kTests);
            for (int b = 0; b < a; ++b) {
                Histogram square(kSide, kSide);
                for (const vec4& u : numbers) square.add(d(u[a]), d(u[b]));
                test::expectLikely(name + " with " + std::to_string(b), square.counts(), square.uniform(),
                                   kTests);
            }
        }
    }
}

TEST_F(Random, neighboursAreIndependent) {
    const std::vector<vec4> numbers = draw({});
    // To the right and below; every number is in one pair only, else the pairs would not be independent.
    for (const std::size_t step : {std::size_t{1}, std::size_t{1024}}) {
        for (int c = 0; c < 4; ++c) {
            Histogram square(kSide, kSide);
            for (std::size_t i = 0; i < numbers.size(); ++i)
                if (i / step % 2 == 0) square.add(d(numbers[i][c]), d(numbers[i + step][c]));
            test::expectLikely("step " + std::to_string(step), square.counts(), square.uniform(), kTests);
        }
    }
}

TEST_F(Random, samplesDimensionsAndSeedsAreIndependent) {
    Push other_index, other_dimension, other_seed;
    ++other_index.index;
    ++other_dimension.dimension;
    ++other_seed.seed;
    const std::vector<vec4> numbers = draw({});
    for (const Push& push : {other_index, other_dimension, other_seed}) {
        const std::vector<vec4> others = draw(push);
        for (int c = 0; c < 4; ++c) {
            Histogram square(kSide, kSide);
            for (std::size_t i = 0; i < numbers.size(); ++i) square.add(d(numbers[i][c]), d(others[i][c]));
            test::expectLikely("pairs", square.counts(), square.uniform(), kTests);
        }
    }
}

TEST_F(Random, anAddressAlwaysGivesTheSameNumbers) {
    const std::vector<vec4> numbers = draw({});
    EXPECT_EQ(numbers, draw({}));
    std::set<float> distinct;
    for (const vec4& u : numbers) distinct.insert(u.x);
    // 2^20 draws of 2^24 values: 1 - exp(-1/16) of them are met, with a deviation below sqrt(2^20 / 32).
    const double met = 0x1p24 * -std::expm1(-0x1p-4);
    EXPECT_NEAR(static_cast<double>(distinct.size()), met, 4.5 * std::sqrt(0x1p20 / 32.0));
}

TEST_F(Random, extremeWordsStayInRange) {
    Push push = shape(kWords);
    push.count = 1;
    const vec4 u = draw(push, {uvec4(0U, 0xffU, 0x100U, 0xffffffffU)}).at(0);
    EXPECT_EQ(u, vec4(0.0F, 0.0F, 0x1p-24F, 1.0F - 0x1p-24F));
}

double turn(double x, double y) {
    const double angle = std::atan2(y, x) / (2.0 * kPi);
    return angle < 0.0 ? angle + 1.0 : angle;
}

TEST_F(Warps, disc) {
    Histogram cells(kSide, kSide);
    for (const vec4& p : draw(shape(kDisc))) {
        const double r2 = d(p.x) * d(p.x) + d(p.y) * d(p.y);
        ASSERT_LE(r2, 1.0 + 8.0 * kUnit);
        cells.add(turn(d(p.x), d(p.y)), r2);  // equal rings have equal steps of r^2
    }
    test::expectLikely("disc", cells.counts(), cells.uniform(), kTests);
}

TEST_F(Warps, cosineHemisphere) {
    Histogram cells(kSide, kSide);
    for (const vec4& w : draw(shape(kCosine))) {
        ASSERT_GE(w.z, 0.0F);
        // Squares of length differ from one by the roundings of three components, 2 u of length.
        ASSERT_NEAR(d(w.x) * d(w.x) + d(w.y) * d(w.y) + d(w.z) * d(w.z), 1.0, 8.0 * kUnit);
        ASSERT_NEAR(d(w.w), d(w.z) / kPi, 2.0 * kUnit);
        cells.add(turn(d(w.x), d(w.y)), d(w.z) * d(w.z));  // cos / pi integrates to equal steps of cos^2
    }
    test::expectLikely("cosine", cells.counts(), cells.uniform(), kTests);
}

TEST_F(Warps, uniformSphere) {
    Histogram cells(kSide, kSide);
    for (const vec4& w : draw(shape(kSphere))) {
        ASSERT_NEAR(d(w.x) * d(w.x) + d(w.y) * d(w.y) + d(w.z) * d(w.z), 1.0, 8.0 * kUnit);
        cells.add(turn(d(w.x), d(w.y)), 0.5 - 0.5 * d(w.z));  // Archimedes: equal steps of z
    }
    test::expectLikely("sphere", cells.counts(), cells.uniform(), kTests);
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
    for (const vec4& b : draw(shape(kTriangle))) {
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
    for (const vec4& p : draw(shape(kCircle))) {
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
