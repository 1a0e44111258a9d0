#pragma once
// What holds of every lobe: it is reciprocal, its samples go where its density says, its density integrates
// to what is not absorbed, and it gives no more light than it gets.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "histogram.h"
#include "kernel.h"
#include "licht/core/math.h"
#include "licht/film/error_estimate.h"
#include "licht/measure/statistics.h"

namespace licht::test {

/// Off the axes, so that x and y both matter.
inline vec3 towards(double cosine, double phi = 0.7) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// A lobe of one kernel (see lobe_kernel.glsl) with its parameters. They follow two words, count and seed, in
/// the kernel's push constants.
template <typename Parameters>
class Lobe {
public:
    Lobe(Kernel& kernel, std::string name, const Parameters& parameters)
        : kernel_(&kernel), name_(std::move(name)), parameters_(parameters) {}

    struct Answer {
        vec4 value;    ///< f, pdf
        vec4 sampled;  ///< wi, pdf; -1: absorbed
        vec4 weight;
    };
    [[nodiscard]] std::vector<Answer> ask(const std::vector<vec4>& pairs) const {
        struct {
            std::uint32_t count;
            std::uint32_t seed;
            std::uint32_t pad[2];
            Parameters parameters;
        } const push{static_cast<std::uint32_t>(pairs.size() / 2), 3, {0, 0}, parameters_};
        return kernel_->template run<Answer>(push.count, push.count, push, pairs);
    }

    void expectReciprocal() const {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> unit(0.001, 1.0);
        std::vector<vec4> there;
        std::vector<vec4> back;
        for (int i = 0; i < 4096; ++i) {
            const vec4 wo(towards(unit(random), 6.28 * unit(random)), 0.0F);
            const vec4 wi(towards(unit(random), 6.28 * unit(random)), 0.0F);
            there.insert(there.end(), {wo, wi});
            back.insert(back.end(), {wi, wo});
        }
        const std::vector<Answer> a = ask(there);
        const std::vector<Answer> b = ask(back);
        for (std::size_t i = 0; i < a.size(); ++i) {
            // Directions are unit to 2 u, which the length of wo + wi divides; a Fresnel factor changes by at
            // most 8 times its argument, and everything else rounds below 24 times.
            const double length = static_cast<double>(glm::length(there[2 * i] + there[2 * i + 1]));
            const double tolerance = (24.0 + 48.0 * (1.0 + 1.0 / length)) * 0x1p-24;
            for (int c = 0; c < 3; ++c) {
                const auto f = static_cast<double>(a[i].value[c]);
                ASSERT_NEAR(f, static_cast<double>(b[i].value[c]), tolerance * f) << name_ << " " << i;
            }
        }
    }

    /// Chi-square of the samples for wo against the density, and the integral of that. For lobes that a grid
    /// of directions resolves: GGX widths from 0.25 up. `tests`: of the file together.
    void expectSamplesFollowDensity(const vec3& wo, int tests) const {
        const std::vector<Answer> samples = ask(pairsOf(wo, std::vector<vec3>(kSamples, vec3(0, 0, 1))));
        Histogram cells(kColumns, kRows);
        std::vector<vec3> sampled;
        double absorbed = 0.0;
        for (const Answer& s : samples) {
            absorbed += s.sampled.w < 0.0F ? 1.0 : 0.0;
            if (s.sampled.w < 0.0F) continue;
            sampled.emplace_back(s.sampled);
            const double turn =
                std::atan2(static_cast<double>(s.sampled.y), static_cast<double>(s.sampled.x)) /
                (2.0 * std::numbers::pi);
            cells.add(turn < 0.0 ? turn + 1.0 : turn, static_cast<double>(s.sampled.z));
        }
        const std::vector<double> fine = cellProbabilities(wo, 16);
        const std::vector<double> coarse = cellProbabilities(wo, 8);
        double sum = 0.0;
        double quadrature_error = 0.0;
        std::vector<std::uint64_t> counts = cells.counts();
        std::vector<double> expected;
        for (std::size_t i = 0; i < fine.size(); ++i) {
            sum += fine[i];
            quadrature_error += std::abs(fine[i] - coarse[i]);
            expected.push_back(fine[i] * kSamples);
        }
        counts.push_back(static_cast<std::uint64_t>(absorbed));
        expected.push_back(std::max((1.0 - sum) * kSamples, 1.0));
        expectLikely(name_, counts, expected, tests);
        const double share = absorbed / kSamples;
        const double noise = 4.5 * std::sqrt(share * (1.0 - share) / kSamples) + 12.0 / kSamples;
        EXPECT_NEAR(sum, 1.0 - share, noise + quadrature_error) << name_;
        EXPECT_LT(quadrature_error, 2e-3) << name_;
        expectWeights(wo, samples, sampled);
    }

    /// A furnace: all light that comes is one. `allowance`: of what rounding of the lobe is known to add.
    void expectNoGain(const vec3& wo, double allowance = 0.0) const {
        for (const RunningStatistics& statistics : furnace(wo)) {
            EXPECT_LE(statistics.mean(),
                      1.0 + allowance + 4.5 * std::sqrt(statistics.varianceOfMean()) + 0x1p-18)
                << name_;
            EXPECT_GT(statistics.mean(), 0.0) << name_;
        }
    }

    /// The same furnace shows at least 1 - loss.
    void expectLittleLoss(const vec3& wo, double loss) const {
        for (const RunningStatistics& statistics : furnace(wo))
            EXPECT_GE(statistics.mean(), 1.0 - loss - 4.5 * std::sqrt(statistics.varianceOfMean()))
                << name_ << ", cosine " << wo.z;
    }

private:
    static constexpr std::uint32_t kSamples = 1U << 17U;
    static constexpr std::size_t kColumns = 32;  // phi
    static constexpr std::size_t kRows = 16;     // the cosine of wi

    /// What samples carry, by channel.
    [[nodiscard]] std::array<RunningStatistics, 3> furnace(const vec3& wo) const {
        std::array<RunningStatistics, 3> statistics;
        for (const Answer& s : ask(pairsOf(wo, std::vector<vec3>(kSamples, vec3(0, 0, 1)))))
            for (int c = 0; c < 3; ++c)
                statistics.at(static_cast<std::size_t>(c))
                    .add(s.sampled.w < 0.0F ? 0.0 : static_cast<double>(s.weight[c]));
        return statistics;
    }

    static std::vector<vec4> pairsOf(const vec3& wo, const std::vector<vec3>& wi) {
        std::vector<vec4> pairs;
        for (const vec3& w : wi) pairs.insert(pairs.end(), {vec4(wo, 0.0F), vec4(w, 0.0F)});
        return pairs;
    }

    [[nodiscard]] std::vector<double> cellProbabilities(const vec3& wo, std::size_t inner) const {
        std::vector<vec3> directions;
        const std::size_t per_cell = inner * inner;
        for (std::size_t i = 0; i < kRows * kColumns * per_cell; ++i) {
            const std::size_t cell = i / per_cell;
            const auto row = static_cast<double>(cell / kColumns) +
                             (static_cast<double>(i % per_cell / inner) + 0.5) / static_cast<double>(inner);
            const auto column = static_cast<double>(cell % kColumns) +
                                (static_cast<double>(i % inner) + 0.5) / static_cast<double>(inner);
            directions.push_back(towards(row / kRows, 2.0 * std::numbers::pi * column / kColumns));
        }
        const std::vector<Answer> answers = ask(pairsOf(wo, directions));
        std::vector<double> sums(kRows * kColumns, 0.0);
        const double solid_angle = 2.0 * std::numbers::pi / static_cast<double>(answers.size());
        for (std::size_t i = 0; i < answers.size(); ++i)
            sums[i / per_cell] += static_cast<double>(answers[i].value.w) * solid_angle;
        return sums;
    }

    /// A sample's density is the one that evaluating finds, and its weight f cos / pdf.
    void expectWeights(const vec3& wo, const std::vector<Answer>& samples,
                       const std::vector<vec3>& sampled) const {
        const std::vector<Answer> answers = ask(pairsOf(wo, sampled));
        std::size_t i = 0;
        for (const Answer& s : samples) {
            if (s.sampled.w < 0.0F) continue;
            const vec4& value = answers[i++].value;
            ASSERT_NEAR(s.sampled.w, value.w, 1e-4F * value.w) << name_;
            for (int c = 0; c < 3; ++c) {
                const float weight = value[c] * s.sampled.z / value.w;
                ASSERT_NEAR(s.weight[c], weight, 1e-4F * weight) << name_;
            }
        }
    }

    Kernel* kernel_;
    std::string name_;
    Parameters parameters_;
};

}  // namespace licht::test
