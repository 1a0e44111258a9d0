// The device's sequences: uniform, independent where they say so, and evenly spread where they say so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "histogram.h"
#include "kernel.h"
#include "licht/core/math.h"
#include "licht/shared/choices.h"
#include "licht/shared/constants.h"
#include "licht/spirv/sampler_comp.h"
#include "support/slope.h"

namespace licht {
namespace {

using test::Histogram;

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kCount = 1U << 20U;
constexpr std::size_t kSide = 32;
// Chi-square tests in this file. Of each of three sequences: 4 ways to vary times (4 channels + 6 pairs), and
// other dimensions and seeds times 4 channels; of those that are independent over the picture: 2 neighbours
// times 4 channels; of random numbers other samples times 4 channels.
constexpr int kTests = 3 * (4 * 10 + 2 * 4) + 2 * (2 * 4) + 4;

enum What : std::uint32_t { kNumbers, kWords, kSums };
enum Varies : std::uint32_t { kPixel, kIndex, kDimension, kSeed };

struct Push {
    std::uint32_t count = kCount;
    std::uint32_t what = kNumbers;
    std::uint32_t index = 3;
    std::uint32_t dimension = 1;
    std::uint32_t seed = 5;
    std::uint32_t varies = kPixel;
    std::uint32_t samples = 1;
};

Push varying(Varies v) {
    Push push;
    push.varies = v;
    return push;
}

double d(float x) {
    return static_cast<double>(x);
}

class OnDevice {
public:
    explicit OnDevice(std::uint32_t sampler, std::uint32_t blue_bits = 4)
        : kernel_("sampler", sampler_comp, {{kConstantSampler, sampler}, {kConstantBlueBits, blue_bits}}) {}
    std::vector<vec4> draw(const Push& push, const std::vector<glm::uvec4>& words = {glm::uvec4(0U)}) {
        return kernel_.run<vec4>(push.count, push.count, push, words);
    }

private:
    test::Kernel kernel_;
};

std::string nameOf(std::uint32_t sampler) {
    return sampler == kSamplerSobol ? "sobol" : sampler == kSamplerBlue ? "blue" : "random";
}

class EverySequence : public testing::TestWithParam<std::uint32_t> {
protected:
    std::vector<vec4> draw(const Push& push) { return device_.draw(push); }

private:
    OnDevice device_{GetParam()};
};

TEST_P(EverySequence, everyChannelAndPairIsUniform) {
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

void expectIndependent(const std::vector<vec4>& numbers, const std::vector<vec4>& others,
                       const std::string& name) {
    for (int c = 0; c < 4; ++c) {
        Histogram square(kSide, kSide);
        for (std::size_t i = 0; i < numbers.size(); ++i) square.add(d(numbers[i][c]), d(others[i][c]));
        test::expectLikely(name + " channel " + std::to_string(c), square.counts(), square.uniform(), kTests);
    }
}

TEST_P(EverySequence, dimensionsAndSeedsAreIndependent) {
    Push other_dimension;
    Push other_seed;
    ++other_dimension.dimension;
    ++other_seed.seed;
    const std::vector<vec4> numbers = draw({});
    expectIndependent(numbers, draw(other_dimension), "dimension");
    expectIndependent(numbers, draw(other_seed), "seed");
}

// Other sequences are evenly spread over the samples of a pixel, and so not independent there.
TEST(Random, samplesAreIndependent) {
    OnDevice device(kSamplerRandom);
    Push other;
    ++other.index;
    expectIndependent(device.draw({}), device.draw(other), "sample");
}

// Blue noise is not independent of its neighbours.
TEST(PixelsAlone, neighboursAreIndependent) {
    for (const std::uint32_t sampler : {kSamplerSobol, kSamplerRandom}) {
        const std::vector<vec4> numbers = OnDevice(sampler).draw({});
        // To the right and below; every number is in one pair only, else the pairs would not be independent.
        for (const std::size_t step : {std::size_t{1}, std::size_t{1024}}) {
            std::vector<vec4> here;
            std::vector<vec4> there;
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                if (i / step % 2 != 0) continue;
                here.push_back(numbers[i]);
                there.push_back(numbers[i + step]);
            }
            expectIndependent(here, there, nameOf(sampler) + " step " + std::to_string(step));
        }
    }
}

TEST_P(EverySequence, anAddressAlwaysGivesTheSameNumbers) {
    const std::vector<vec4> numbers = draw({});
    EXPECT_EQ(numbers, draw({}));
    std::set<float> distinct;
    for (const vec4& u : numbers) distinct.insert(u.x);
    // 2^20 draws of 2^24 values: 1 - exp(-1/16) of them are met, with a deviation below sqrt(2^20 / 32). Blue
    // noise meets more, because its pixels share them out.
    const double met = 0x1p24 * -std::expm1(-0x1p-4);
    const double allowed = 4.5 * std::sqrt(0x1p20 / 32.0);
    EXPECT_GT(static_cast<double>(distinct.size()), met - allowed);
    if (GetParam() != kSamplerBlue) {
        EXPECT_LT(static_cast<double>(distinct.size()), met + allowed);
    }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    double sa = 0.0, sb = 0.0, saa = 0.0, sbb = 0.0, sab = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sa += a[i];
        sb += b[i];
        saa += a[i] * a[i];
        sbb += b[i] * b[i];
        sab += a[i] * b[i];
    }
    return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

// Tables of Sobol's numbers end at dimension 1024, and what follows repeats what was before. A path of 500
// bounces takes 2004 dimensions of four numbers.
TEST_P(EverySequence, dimensionsNeverRepeat) {
    constexpr std::uint32_t kSamples = 1U << 14U;
    for (const std::uint32_t dimension : {1U, 2U, 3U, 255U, 477U}) {
        for (const Varies varies : {kPixel, kIndex}) {
            Push push = varying(varies);
            push.count = kSamples;
            push.index = 0;
            push.dimension = dimension;
            const std::vector<vec4> near = draw(push);
            push.dimension += 1024;
            const std::vector<vec4> far = draw(push);
            for (int a = 0; a < 4; ++a) {
                for (int b = 0; b < 4; ++b) {
                    std::vector<double> x;
                    std::vector<double> y;
                    for (std::uint32_t i = 0; i < kSamples; ++i) {
                        x.push_back(d(near[i][a]));
                        y.push_back(d(far[i][b]));
                    }
                    // 4.5: of 480 correlations 3 % would exceed 4 by chance.
                    EXPECT_LT(std::abs(correlation(x, y)), 4.5 / std::sqrt(double{kSamples}))
                        << "dimension " << dimension << " varies " << varies << " channels " << a << b;
                }
            }
        }
    }
    // One path: its numbers against those 1024 dimensions further on.
    constexpr std::size_t kLength = 1U << 16U;
    Push push = varying(kDimension);
    push.count = kLength + 1024;
    const std::vector<vec4> path = draw(push);
    for (int c = 0; c < 4; ++c) {
        std::vector<double> x;
        std::vector<double> y;
        for (std::size_t i = 0; i < kLength; ++i) {
            x.push_back(d(path[i][c]));
            y.push_back(d(path[i + 1024][c]));
        }
        EXPECT_LT(std::abs(correlation(x, y)), 4.0 / std::sqrt(double{kLength})) << c;
    }
}

TEST_P(EverySequence, theLastSamplesAreAllDifferent) {
    Push push = varying(kIndex);
    push.count = 16;
    push.index = 0xfffffff0U;
    const std::vector<vec4> last = draw(push);
    push.index = 0;
    const std::vector<vec4> first = draw(push);
    std::set<std::pair<float, float>> distinct;
    for (const std::vector<vec4>& numbers : {first, last})
        for (const vec4& u : numbers) distinct.insert({u.x, u.y});
    EXPECT_EQ(distinct.size(), 32U);
}

INSTANTIATE_TEST_SUITE_P(Sampler, EverySequence, testing::Values(kSamplerSobol, kSamplerBlue, kSamplerRandom),
                         [](const auto& instance) { return nameOf(instance.param); });

TEST(Words, extremesStayInRange) {
    Push push;
    push.what = kWords;
    push.count = 1;
    OnDevice device(kSamplerSobol);
    EXPECT_EQ(device.draw(push, {glm::uvec4(0U, 0xffU, 0x100U, 0xffffffffU)}).at(0),
              vec4(0.0F, 0.0F, 0x1p-24F, 1.0F - 0x1p-24F));
    EXPECT_EQ(device.draw(push, {glm::uvec4(0x7fffffffU, 0x80000000U, 0xffffff00U, 0xffffff7fU)}).at(0),
              vec4(0.5F - 0x1p-24F, 0.5F, 1.0F - 0x1p-24F, 1.0F - 0x1p-24F));
}

/// Number of boxes 2^-a x 2^-b, a + b = log2 of the points, that do not hold exactly one point of a pair.
std::size_t wrongBoxes(const std::vector<vec4>& points, int pair, unsigned log2_count) {
    std::size_t wrong = 0;
    for (unsigned a = 0; a <= log2_count; ++a) {
        std::vector<int> boxes(points.size());
        const unsigned b = log2_count - a;
        for (const vec4& u : points) {
            const auto x = static_cast<std::size_t>(std::ldexp(u[2 * pair], static_cast<int>(a)));
            const auto y = static_cast<std::size_t>(std::ldexp(u[2 * pair + 1], static_cast<int>(b)));
            ++boxes.at(x << b | y);
        }
        wrong += static_cast<std::size_t>(
            std::count_if(boxes.begin(), boxes.end(), [](int points_in) { return points_in != 1; }));
    }
    return wrong;
}

TEST(Sobol, everyBoxOfEveryPowerOfTwoHoldsOnePoint) {
    OnDevice device(kSamplerSobol);
    Push push = varying(kIndex);
    for (unsigned k = 0; k <= 13; ++k) {
        push.count = 1U << k;
        // From the start, from a later power of two, and the last ones.
        for (const std::uint32_t first : {0U, 5U << k, 0U - (1U << k)}) {
            push.index = first;
            push.dimension += 7;
            ++push.seed;
            const std::vector<vec4> points = device.draw(push);
            for (int pair = 0; pair < 2; ++pair)
                ASSERT_EQ(wrongBoxes(points, pair, k), 0U) << push.count << " points from " << first;
        }
    }
    // The test sees numbers that are not a net.
    push.count = 256;
    EXPECT_GT(wrongBoxes(OnDevice(kSamplerRandom).draw(push), 0, 8), 256U);
}

// A block of samples of every aligned block of pixels, square or twice as wide as high, is a net of its own.
TEST(Blue, everyBlockOfPixelsSharesItsPointsEvenly) {
    for (const std::uint32_t bits : {0U, 1U, 2U, 4U, 7U}) {
        OnDevice device(kSamplerBlue, bits);
        // Samples of the second block of each pixel of the first 64 rows.
        std::vector<std::vector<vec4>> samples;
        for (std::uint32_t s = 0; s < 1U << bits; ++s) {
            Push push;
            push.count = 1U << 16U;
            push.index = (1U << bits) + s;
            samples.push_back(device.draw(push));
        }
        for (unsigned k = 0; k <= 11 && k + bits <= 13; ++k) {
            const std::size_t width = std::size_t{1} << (k + 1) / 2;
            const std::size_t height = std::size_t{1} << k / 2;
            std::vector<vec4> points;
            for (const std::vector<vec4>& picture : samples)
                for (std::size_t y = height; y < 2 * height; ++y)
                    for (std::size_t x = 3 * width; x < 4 * width; ++x)
                        points.push_back(picture[y * 1024 + x]);
            for (int pair = 0; pair < 2; ++pair)
                ASSERT_EQ(wrongBoxes(points, pair, k + bits), 0U)
                    << width << "x" << height << " pixels, 2^" << bits << " samples";
        }
    }
}

/// Mean power of a picture's error in a ring of frequencies [from, to), in cycles a pixel, and how many
/// independent frequencies were averaged. White noise of variance one has power one.
struct Ring {
    double power = 0.0;
    double frequencies = 0.0;
    [[nodiscard]] double deviationsFromWhite() const { return (power - 1.0) * std::sqrt(frequencies); }
};

constexpr std::size_t kTile = 64;

std::vector<double> spectrum(const std::vector<double>& tile) {
    using Complex = std::complex<double>;
    std::vector<Complex> roots;
    for (std::size_t i = 0; i < kTile; ++i)
        roots.push_back(std::polar(1.0, -2.0 * kPi * static_cast<double>(i) / kTile));
    std::vector<Complex> rows(kTile * kTile);
    for (std::size_t y = 0; y < kTile; ++y)
        for (std::size_t k = 0; k < kTile; ++k)
            for (std::size_t x = 0; x < kTile; ++x)
                rows[y * kTile + k] += tile[y * kTile + x] * roots[k * x % kTile];
    std::vector<double> power;
    for (std::size_t j = 0; j < kTile; ++j) {
        for (std::size_t k = 0; k < kTile; ++k) {
            Complex sum = 0.0;
            for (std::size_t y = 0; y < kTile; ++y) sum += rows[y * kTile + k] * roots[j * y % kTile];
            power.push_back(std::norm(sum) / (kTile * kTile));
        }
    }
    return power;
}

/// Of the mean over `samples` samples of a smooth function of a pair; variance one without stratification.
std::vector<std::vector<double>> errorTiles(OnDevice& device, std::uint32_t samples, int pair) {
    std::vector<double> sums(1024 * kTile);
    for (std::uint32_t s = 0; s < samples; ++s) {
        Push push;
        push.count = static_cast<std::uint32_t>(sums.size());
        push.index = s;
        const std::vector<vec4> numbers = device.draw(push);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] += 4.0 * d(numbers[i][2 * pair]) * d(numbers[i][2 * pair + 1]) - 1.0;
    }
    constexpr double kVariance = 16.0 / 9.0 - 1.0;  // of 4 x y
    std::vector<std::vector<double>> tiles(1024 / kTile);
    for (std::size_t i = 0; i < sums.size(); ++i)
        tiles[i % 1024 / kTile].push_back(sums[i] / std::sqrt(kVariance * samples));
    return tiles;
}

std::vector<Ring> rings(const std::vector<std::vector<double>>& tiles, std::size_t count) {
    std::vector<Ring> result(count);
    for (const std::vector<double>& tile : tiles) {
        const std::vector<double> power = spectrum(tile);
        for (std::size_t i = 1; i < power.size(); ++i) {
            const auto fold = [](std::size_t f) { return static_cast<double>(std::min(f, kTile - f)); };
            const double radius = 2.0 * std::hypot(fold(i % kTile), fold(i / kTile)) / kTile;
            if (radius >= 1.0) continue;
            Ring& ring = result[static_cast<std::size_t>(radius * static_cast<double>(count))];
            ring.power += power[i];
            ring.frequencies += 0.5;  // a frequency and its opposite are one
        }
    }
    for (Ring& ring : result) ring.power /= 2.0 * ring.frequencies;
    return result;
}

TEST(Spectrum, pixelsAloneAreWhite) {
    for (const std::uint32_t sampler : {kSamplerSobol, kSamplerRandom}) {
        OnDevice device(sampler);
        for (int pair = 0; pair < 2; ++pair) {
            std::size_t at = 0;
            for (const Ring& ring : rings(errorTiles(device, 1, pair), 8))
                EXPECT_LT(std::abs(ring.deviationsFromWhite()), 4.5)
                    << nameOf(sampler) << " pair " << pair << " ring " << at++ << ": " << ring.power;
        }
    }
}

TEST(Spectrum, blueLacksLowFrequencies) {
    for (const std::uint32_t bits : {0U, 2U}) {
        OnDevice device(kSamplerBlue, bits);
        OnDevice alone(kSamplerSobol);
        for (int pair = 0; pair < 2; ++pair) {
            const std::vector<Ring> blue = rings(errorTiles(device, 1U << bits, pair), 8);
            const std::vector<Ring> white = rings(errorTiles(alone, 1U << bits, pair), 8);
            // A quarter of the picture's finest frequency: white noise that is filtered by the eye, or by a
            // smaller copy of the picture, loses least there. The ratio of two means is as uncertain as both.
            for (std::size_t i = 0; i < 2; ++i) {
                RecordProperty("blue_" + std::to_string(bits) + std::to_string(pair) + std::to_string(i),
                               std::to_string(blue[i].power / white[i].power));
                const double deviation = std::sqrt(1.0 / blue[i].frequencies + 1.0 / white[i].frequencies);
                EXPECT_LT(blue[i].power, 0.5 * (1.0 - 4.5 * deviation) * white[i].power)
                    << "2^" << bits << " samples, pair " << pair << ", ring " << i;
            }
        }
    }
}

/// Root mean square error over `pixels` pixels after 2^from, 2^(from + 1), ... samples, of two pairs
/// together.
struct Convergence {
    std::vector<double> smooth;
    std::vector<double> disc;
};

Convergence converge(std::uint32_t sampler, unsigned from, unsigned to) {
    constexpr std::uint32_t kPixels = 256;
    constexpr std::uint32_t kSummed = 16;
    Push push;
    push.what = kSums;
    push.index = 0;
    push.samples = 1U << to;
    push.count = kPixels * push.samples / kSummed;
    const std::vector<vec4> sums = OnDevice(sampler, to).draw(push);
    Convergence result;
    for (unsigned k = from; k <= to; ++k) {
        const std::size_t blocks = (std::size_t{1} << k) / kSummed;
        double smooth = 0.0;
        double disc = 0.0;
        for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
            glm::dvec4 sum(0.0);
            for (std::size_t i = 0; i < blocks; ++i)
                sum += glm::dvec4(sums[pixel * push.samples / kSummed + i]);
            sum /= std::ldexp(1.0, static_cast<int>(k));
            smooth += (sum.x - 1.0) * (sum.x - 1.0) + (sum.y - 1.0) * (sum.y - 1.0);
            disc += (sum.z - kPi / 4.0) * (sum.z - kPi / 4.0) + (sum.w - kPi / 4.0) * (sum.w - kPi / 4.0);
        }
        result.smooth.push_back(std::sqrt(smooth / (2.0 * kPixels)));
        result.disc.push_back(std::sqrt(disc / (2.0 * kPixels)));
    }
    return result;
}

// The law of large numbers. Each error is known to 1 / sqrt(2 * 512), 0.045 in log2; the slope over 12
// octaves to 0.01 at most.
TEST(Convergence, randomNumbersGainTheSquareRoot) {
    const Convergence c = converge(kSamplerRandom, 4, 16);
    EXPECT_NEAR(slopeOf(c.smooth), -0.5, 0.05);
    EXPECT_NEAR(slopeOf(c.disc), -0.5, 0.05);
    const double deviation = 0.44 / 4.0;  // of the bump: (6/5)^2 - 1 = 0.44
    EXPECT_NEAR(c.smooth[0], std::sqrt(0.44) / 4.0, 4.5 * deviation * 0.045 * 2.0);
}

// Owen 1997, Scrambled Net Variance for Integrals of Smooth Functions: N^-3/2 times sqrt(log N), which makes
// -1.40 over these octaves. An edge in the plane crosses sqrt(N) of N boxes: N^-3/4.
TEST(Convergence, sobolGainsMore) {
    for (const std::uint32_t sampler : {kSamplerSobol, kSamplerBlue}) {
        const Convergence c = converge(sampler, 4, 12);
        RecordProperty("smooth_" + nameOf(sampler), std::to_string(slopeOf(c.smooth)));
        RecordProperty("disc_" + nameOf(sampler), std::to_string(slopeOf(c.disc)));
        EXPECT_LT(slopeOf(c.smooth), -1.3) << nameOf(sampler);
        EXPECT_NEAR(slopeOf(c.disc), -0.75, 0.05) << nameOf(sampler);
        // Never worse than independent numbers.
        EXPECT_LT(c.smooth[0], std::sqrt(0.44) / 4.0);
    }
}

}  // namespace
}  // namespace licht
