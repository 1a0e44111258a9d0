// Where the samples of the scattering function go, against its density in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "bsdf_reference.h"
#include "histogram.h"
#include "kernel.h"
#include "licht/spirv/bsdf_sampling_comp.h"

namespace licht {
namespace {

using test::dvec3;
using test::Material;
using test::mirror;
using test::outgoing;

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kCount = 1U << 19U;
constexpr std::size_t kColumns = 32;  // phi
constexpr std::size_t kRows = 24;     // the normal's psi, or the cosine of wi
constexpr std::size_t kInner = 24;    // steps of the midpoint rule a cell and axis
constexpr float kAlphas[] = {1e-3F, 0.02F, 0.1F, 0.3F, 1.0F};
constexpr double kCosines[] = {1.0, 0.5, 0.05, 1e-3};
constexpr int kTests = 5 * 4 + (5 * 4 - 1) + 3 * 3;

struct Sample {
    vec4 wi_pdf;  // w: pdf, -1 when absorbed
    vec4 weight;
    vec4 normal;
};

class BsdfSampling : public testing::Test {
protected:
    std::vector<Sample> sample(const Material& material, vec3 wo) {
        struct {
            Material material;
            std::uint32_t count;
            std::uint32_t seed;
            std::uint32_t pad[2];
            vec4 wo;
        } push{material, kCount, 2, {0, 0}, vec4(wo, 0.0F)};
        return kernel_.run<Sample>(kCount, kCount, push, std::vector<std::uint32_t>{0});
    }

private:
    test::Kernel kernel_{"bsdf samples", bsdf_sampling_comp, test::asInTheTextbook()};
};

double turn(const dvec3& w) {
    const double angle = std::atan2(w.y, w.x) / (2.0 * kPi);
    return angle < 0.0 ? angle + 1.0 : angle;
}

/// Rows by the angle psi of test::normalAt, ever finer towards pi / 2, where reflections pass the horizon:
/// the row for psi, psi for the row, and the slope of the latter.
double rowOf(double psi) {
    return 1.0 - std::sqrt(std::max(1.0 - psi / (0.5 * kPi), 0.0));
}
double psiOf(double row) {
    return 0.5 * kPi * row * (2.0 - row);
}
double psiSlope(double row) {
    return kPi * (1.0 - row);
}

void addNormal(test::Histogram& cells, const dvec3& h, double alpha) {
    cells.add(turn(h), rowOf(std::atan(std::hypot(h.x, h.y) / (h.z * alpha))));
}

/// `density` of (row, column) in [0,1)^2 by the midpoint rule against the counts. Cells that the density's
/// edge cuts, where that rule is coarse, go together with the samples that are in none into one cell, which
/// expects what the others leave over.
template <typename Density>
void expectDensity(const std::string& name, const test::Histogram& cells, const Density& density) {
    constexpr double kStep = 1.0 / kInner;
    std::vector<std::uint64_t> counts;
    std::vector<double> expected;
    std::uint64_t count_rest = kCount;
    double expected_rest = kCount;
    for (std::size_t cell = 0; cell < kRows * kColumns; ++cell) {
        double sum = 0.0;
        bool whole = true;
        for (std::size_t inner = 0; inner < kInner * kInner; ++inner) {
            const double row =
                static_cast<double>(cell / kColumns) + (static_cast<double>(inner / kInner) + 0.5) * kStep;
            const double column =
                static_cast<double>(cell % kColumns) + (static_cast<double>(inner % kInner) + 0.5) * kStep;
            const double value = density(row / kRows, column / kColumns);
            whole = whole && value > 0.0;
            sum += value;
        }
        if (!whole) continue;
        counts.push_back(cells.counts()[cell]);
        expected.push_back(sum * kStep * kStep / (kRows * kColumns) * kCount);
        count_rest -= counts.back();
        expected_rest -= expected.back();
    }
    counts.push_back(count_rest);
    // Steps of 1/576 leave the rule wrong by some 1e-6 of the whole, one sample of either sign.
    expected.push_back(std::max(expected_rest, 1.0));
    test::expectLikely(name, counts, expected, kTests);
}

std::string name(float alpha, double cosine) {
    return "alpha " + std::to_string(alpha) + ", cosine " + std::to_string(cosine);
}

TEST_F(BsdfSampling, visibleNormals) {
    for (const float alpha : kAlphas) {
        const auto a = static_cast<double>(alpha);
        for (const double cosine : kCosines) {
            const vec3 wo = outgoing(cosine);
            test::Histogram cells(kColumns, kRows);
            for (const Sample& s : sample(mirror(alpha), wo)) addNormal(cells, dvec3(s.normal), a);
            expectDensity(name(alpha, cosine), cells, [&](double row, double column) {
                const test::NormalCell cell = test::normalAt(a, psiOf(row), column * 2.0 * kPi);
                return test::reference::visibleNormals(a, dvec3(wo), cell.h) * cell.solid_angle *
                       psiSlope(row) * 2.0 * kPi;
            });
        }
    }
}

TEST_F(BsdfSampling, reflectionsOfTheSpecularLayer) {
    for (const float alpha : kAlphas) {
        const auto a = static_cast<double>(alpha);
        for (const double cosine : kCosines) {
            // The normal is found again as wo + wi, a sum as short as 2 cos: fp32 leaves it an error of u /
            // cos, which must stay far below a cell, alpha / 15. The narrowest lobe at the flattest angle has
            // no such room.
            if (0x1p-24 / cosine > a / 15.0 / 10.0) continue;
            const Material material = mirror(alpha);
            const vec3 wo = outgoing(cosine);
            test::Histogram cells(kColumns, kRows);
            for (const Sample& s : sample(material, wo))
                if (s.wi_pdf.w >= 0.0F) addNormal(cells, glm::normalize(dvec3(wo) + dvec3(s.wi_pdf)), a);
            expectDensity(name(alpha, cosine), cells, [&](double row, double column) {
                const test::NormalCell cell = test::normalAt(a, psiOf(row), column * 2.0 * kPi);
                const double cos_h = glm::dot(dvec3(wo), cell.h);
                const dvec3 wi = 2.0 * cos_h * cell.h - dvec3(wo);
                if (cos_h <= 0.0 || wi.z <= 0.0) return 0.0;
                return test::reference::pdf(material, dvec3(wo), wi) * 4.0 * cos_h * cell.solid_angle *
                       psiSlope(row) * 2.0 * kPi;
            });
        }
    }
}

TEST_F(BsdfSampling, bothLobes) {
    // Cells by the direction itself: equal steps of its cosine.
    for (const float alpha : {0.3F, 0.6F, 1.0F}) {
        for (const double cosine : {1.0, 0.5, 0.1}) {
            const Material material = test::plastic(vec3(0.8F, 0.4F, 0.2F), alpha, 0.2F, 1.0F);
            const vec3 wo = outgoing(cosine);
            test::Histogram cells(kColumns, kRows);
            for (const Sample& s : sample(material, wo))
                if (s.wi_pdf.w >= 0.0F) cells.add(turn(dvec3(s.wi_pdf)), static_cast<double>(s.wi_pdf.z));
            expectDensity(name(alpha, cosine), cells, [&](double row, double column) {
                const double r = std::sqrt(1.0 - row * row);
                const dvec3 wi(r * std::cos(2.0 * kPi * column), r * std::sin(2.0 * kPi * column), row);
                return test::reference::pdf(material, dvec3(wo), wi) * 2.0 * kPi;
            });
        }
    }
}

}  // namespace
}  // namespace licht
