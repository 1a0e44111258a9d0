// Solid angles of triangles, rectangles and cones, and directions spread evenly over them, against double
// precision, closed forms and chi-square.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "histogram.h"
#include "kernel.h"
#include "licht/core/math.h"
#include "licht/spirv/spherical_comp.h"
#include "spherical_reference.h"

namespace licht {
namespace {

using namespace test;

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kSide = 16;  // of the grid of cells, on the shape itself
constexpr std::size_t kSamples = 1U << 18U;
constexpr int kChiSquares = 6 + 6 + 4;  // triangles, rectangles, cones

struct Question {
    vec4 a, b, c, u;
};

struct Push {
    std::uint32_t count;
    std::uint32_t shape;
};

double d(float x) {
    return static_cast<double>(x);
}

bool finite(const vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

std::vector<dvec2> uniformNumbers(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<dvec2> numbers(count);
    for (dvec2& u : numbers) {
        u.x = static_cast<double>(random() >> 8U) * 0x1p-24;
        u.y = static_cast<double>(random() >> 8U) * 0x1p-24;
    }
    return numbers;
}

class Spherical : public testing::Test {
protected:
    std::vector<vec4> ask(Shape shape, const std::vector<Question>& questions) {
        const auto count = static_cast<std::uint32_t>(questions.size());
        return kernel_.run<vec4>(count, count, Push{count, shape}, questions);
    }
    // One sample of each patch, all of one shape.
    std::vector<vec4> ask(const std::vector<Patch>& patches, const std::vector<dvec2>& u) {
        std::vector<Question> questions;
        for (std::size_t i = 0; i < patches.size(); ++i) {
            const Patch& p = patches[i];
            questions.push_back(
                {vec4(vec3(p.a), 0), vec4(vec3(p.b), 0), vec4(vec3(p.c), 0), vec4(u[i].x, u[i].y, 0, 0)});
        }
        return ask(patches.at(0).shape, questions);
    }
    std::vector<vec4> draw(const Patch& p, const std::vector<dvec2>& u) {
        return ask(std::vector<Patch>(u.size(), p), u);
    }
    float askAngle(const Patch& p) { return draw(p, {dvec2(0.5)})[0].w; }
    // The solid angles between which the shapes are sampled by solid angle.
    dvec2 limits() { return dvec2(ask(kLimits, {Question{}})[0]); }

private:
    Kernel kernel_{"spherical", spherical_comp};
};

TEST_F(Spherical, arctangentIsExactToFourUnitsInTheLastPlace) {
    std::vector<Question> questions;
    constexpr int kSteps = 1 << 18;
    for (int i = 0; i < kSteps; ++i) {
        const float t = static_cast<float>(i + 1) / kSteps;
        for (const vec4& yx : {vec4(t, 1, 0, 0), vec4(t, -1, 0, 0), vec4(1, t, 0, 0), vec4(1, -t, 0, 0)})
            questions.push_back({yx, {}, {}, {}});
    }
    for (int e = -120; e <= 120; ++e)
        questions.push_back({vec4(std::ldexp(1.5F, e), 1.0F, 0, 0), {}, {}, {}});
    const std::vector<vec4> angles = ask(kArctangent, questions);
    double worst = 0.0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const double wanted = std::atan2(d(questions[i].a.x), d(questions[i].a.y));
        worst = std::max(worst, std::abs(d(angles[i].x) / wanted - 1.0));
    }
    RecordProperty("worst", std::to_string(worst / kRounding));
    EXPECT_LE(worst,
              8.0 * kRounding);  // division 2.5 ulp, polynomial and the step to the octant 1.5: of twice a
                                 // rounding each
    const std::vector<vec4> ends =
        ask(kArctangent, {{vec4(0, 0, 0, 0), {}, {}, {}}, {vec4(0, -1, 0, 0), {}, {}, {}}});
    EXPECT_EQ(ends[0].x, 0.0F);
    EXPECT_EQ(ends[1].x, static_cast<float>(kPi));
}

TEST_F(Spherical, closedForms) {
    const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    for (const double scale : {1e-5, 1.0, 1e5}) {
        for (const Patch& octant : {triangle(scale * x, y, z), triangle(y, scale * x, 3.0 * z)})
            EXPECT_NEAR(d(askAngle(octant)), kPi / 2.0, kPi / 2.0 * angleBound(octant));
        const Patch face = rectangle(scale * dvec3(-1, -1, 1), 2.0 * scale * x, 2.0 * scale * y);
        EXPECT_NEAR(d(askAngle(face)), 2.0 * kPi / 3.0, 2.0 * kPi / 3.0 * angleBound(face));
        const Patch square = rectangle(scale * dvec3(-0.5, -0.5, 1), scale * x, scale * y);
        EXPECT_NEAR(d(askAngle(square)), 0.805432, 1e-6);  // as many digits as the number has
        const Patch half =
            triangle(scale * dvec3(-0.5, -0.5, 1), scale * dvec3(0.5, -0.5, 1), scale * dvec3(0.5, 0.5, 1));
        EXPECT_NEAR(d(askAngle(half)), 0.402716, 1e-6);
    }
    for (const double a : {0.001, 0.1, 1.0, 30.0})
        for (const double b : {0.003, 0.5, 20.0})
            for (const double distance : {0.25, 1.0, 50.0}) {
                const Patch p = rectangle(dvec3(-a, -b, distance), 2.0 * a * x, 2.0 * b * y);
                const double wanted =
                    4.0 * std::atan(a * b / (distance * std::sqrt(a * a + b * b + distance * distance)));
                // The three sides' roundings to fp32 reach the angle at most threefold.
                EXPECT_NEAR(d(askAngle(p)), wanted, wanted * (angleBound(p) + 9.0 * kRounding))
                    << a << ' ' << b << ' ' << distance;
            }
}

TEST_F(Spherical, sizesAgreeWithDoublePrecision) {
    for (const Shape shape : {kTriangle, kRectangle}) {
        const std::vector<Patch> patches = randomPatches(shape, 200'000);
        const std::vector<vec4> answers = ask(patches, uniformNumbers(patches.size(), 1));
        double worst = 0.0, worst_share = 0.0;
        std::array<std::size_t, 9> all{}, coarse{};
        for (std::size_t i = 0; i < patches.size(); ++i) {
            const double exact = solidAngle(patches[i]);
            const double error = std::abs(d(answers[i].w) / exact - 1.0);
            ASSERT_LE(error, angleBound(patches[i])) << shape << " of " << exact << " sr";
            worst = std::max(worst, error);
            worst_share = std::max(worst_share, error / angleBound(patches[i]));
            const auto decade = static_cast<std::size_t>(std::floor(std::log10(exact) + 7.0));
            ++all.at(decade);
            coarse.at(decade) += error > 1e-4 ? 1U : 0U;
        }
        std::string report;
        for (std::size_t i = 0; i < 8; ++i) {
            report += " 1e" + std::to_string(static_cast<int>(i) - 7) + ": " + std::to_string(coarse[i]) +
                      "/" + std::to_string(all[i]);
        }
        const std::string name = shape == kTriangle ? "triangle" : "rectangle";
        RecordProperty(name + "_above_1e-4", report);
        RecordProperty(name + "_worst", std::to_string(1e6 * worst));
        RecordProperty(name + "_worst_share_of_bound", std::to_string(worst_share));
    }
}

TEST_F(Spherical, aTriangleIsTheSumOfItsHalves) {
    std::mt19937 random(3);
    const auto coordinate = [&] {
        return (static_cast<double>(random() % 2048U) - 1024.0) / 512.0;
    };  // halves are exact in fp32
    std::vector<Patch> patches;
    for (int i = 0; i < 3000; ++i) {
        const auto vertex = [&] { return dvec3(coordinate(), coordinate(), coordinate()); };
        const dvec3 a = vertex(), b = vertex(), c = vertex(), middle = 0.5 * (b + c);
        patches.insert(patches.end(), {triangle(a, b, c), triangle(a, b, middle), triangle(middle, c, a)});
    }
    const std::vector<vec4> answers = ask(patches, uniformNumbers(patches.size(), 1));
    for (std::size_t i = 0; i < patches.size(); i += 3) {
        double tolerance = 0.0;
        for (std::size_t j = i; j < i + 3; ++j) {
            const double angle = solidAngle(patches[j]);
            tolerance += angle > 0.0 ? angle * angleBound(patches[j]) : 0.0;
        }
        ASSERT_NEAR(d(answers[i].w), d(answers[i + 1].w) + d(answers[i + 2].w), tolerance) << i;
    }
}

TEST_F(Spherical, samplesAreUniformBySolidAngle) {
    const std::vector<dvec2> u = uniformNumbers(kSamples, 11);
    for (const Shape shape : {kTriangle, kRectangle}) {
        const std::vector<Patch> patches = namedPatches(shape);
        for (std::size_t k = 0; k < patches.size(); ++k) {
            const Patch& p = patches[k];
            // Cells lie evenly on the plane and know nothing of the sampler; those on the diagonal of a
            // triangle are cut in half.
            std::vector<double> expected(kSide * kSide);
            for (std::size_t y = 0; y < kSide; ++y)
                for (std::size_t x = 0; x < kSide; ++x) {
                    const auto corner = [&](std::size_t i, std::size_t j) {
                        return pointAt(p, dvec2(i, j) / static_cast<double>(kSide));
                    };
                    const dvec3 a = corner(x, y), b = corner(x + 1, y), c = corner(x, y + 1),
                                o = corner(x + 1, y + 1);
                    double& share = expected[y * kSide + x];
                    if (shape == kRectangle || x + y + 1 <= kSide) share += std::abs(signedAngle(a, b, c));
                    if (shape == kRectangle || x + y + 2 <= kSide) share += std::abs(signedAngle(b, o, c));
                    share *= kSamples / solidAngle(p);
                }
            if (shape == kTriangle)
                for (std::size_t y = 0; y < kSide; ++y)
                    for (std::size_t x = kSide - y; x < kSide; ++x) expected[y * kSide + x] = 0.0;
            Histogram cells(kSide, kSide);
            for (const vec4& w : draw(p, u)) {
                dvec2 place = placeOf(p, dvec3(w));
                // A rounding beyond the diagonal belongs to its cells.
                if (shape == kTriangle) place /= std::max(1.0, (place.x + place.y) / (1.0 - 1e-9));
                cells.add(place.x, place.y);
            }
            expectLikely(std::to_string(shape) + " patch " + std::to_string(k), cells.counts(), expected,
                         kChiSquares);
        }
    }
}

TEST_F(Spherical, directionsAreUnitInsideAndInvertible) {
    for (const Shape shape : {kTriangle, kRectangle}) {
        std::vector<Patch> patches = randomPatches(shape, 50'000);
        std::vector<dvec2> u = uniformNumbers(patches.size(), 5);
        constexpr double kLast = 1.0 - 0x1p-24;
        const dvec2 ends[] = {{0, 0},   {kLast, 0}, {0, kLast},   {kLast, kLast}, {0x1p-24, 0x1p-24},
                              {0.5, 0}, {0, 0.5},   {0.5, kLast}, {kLast, 0.5}};
        for (std::size_t i = 0; i < 20 * std::size(ends); ++i) u[i] = ends[i % std::size(ends)];
        const std::vector<vec4> answers = ask(patches, u);
        double worst_length = 0.0, worst_outside = 0.0, worst_share = 0.0;
        for (std::size_t i = 0; i < patches.size(); ++i) {
            const Patch& p = patches[i];
            ASSERT_TRUE(finite(answers[i])) << i;
            const dvec3 w(answers[i]), unit = normalize(w);
            if (shape == kTriangle) worst_length = std::max(worst_length, std::abs(length(w) - 1.0));
            const double off = directionBound(p, w);
            worst_outside = std::max(worst_outside, outside(p, unit) / off);
            if (i < 20 * std::size(ends)) continue;
            // What these errors of the direction, of the solid angle and of the shape's frame do to u, by the
            // inverse in double precision.
            const dvec2 back = inverse(p, unit);
            dvec2 allowed(angleBound(p) + 8.0 * kRounding);
            for (const dvec3 axis : {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}) {
                const auto add = [&](const Patch& moved, dvec3 direction) {
                    allowed += abs(inverse(moved, direction) - back);
                };
                add(p, unit + off * axis);
                const dvec3 step = 8.0 * kRounding * axis;
                add({shape, p.a + (shape == kTriangle ? 1.0 : 3.5) * length(p.a) * step, p.b, p.c}, unit);
                if (shape == kTriangle) add({shape, p.a, p.b + length(p.b) * step, p.c}, unit);
                if (shape == kTriangle) add({shape, p.a, p.b, p.c + length(p.c) * step}, unit);
            }
            for (int axis = 0; axis < 2; ++axis)
                worst_share = std::max(worst_share, std::abs(back[axis] - u[i][axis]) / allowed[axis]);
        }
        const std::string name = shape == kTriangle ? "triangle" : "rectangle";
        RecordProperty(name + "_length", std::to_string(worst_length / kRounding));
        RecordProperty(name + "_outside_share_of_bound", std::to_string(worst_outside));
        RecordProperty(name + "_inverse_share_of_bound", std::to_string(worst_share));
        EXPECT_LE(worst_length, 1e-6);
        EXPECT_LE(worst_outside, 1.0);
        EXPECT_LE(worst_share, 1.0);
    }
}

struct Mean {
    double sum = 0.0, squares = 0.0, count = 0.0;
    void add(double x) {
        sum += x;
        squares += x * x;
        count += 1.0;
    }
    [[nodiscard]] double value() const { return sum / count; }
    [[nodiscard]] double error() const {
        return std::sqrt(std::max(squares / count - value() * value(), 0.0) / count);
    }
};

TEST_F(Spherical, irradianceIsTheClosedFormBySolidAngleAndByArea) {
    const std::vector<dvec2> u = uniformNumbers(kSamples, 13);
    const auto check = [&](const std::string& name, const Patch& p, dvec3 normal, double wanted) {
        Mean by_angle, by_area;
        const dvec3 e = p.shape == kTriangle ? p.b - p.a : p.b, f = p.shape == kTriangle ? p.c - p.a : p.c;
        const dvec3 area = cross(e, f) * (p.shape == kTriangle ? 0.5 : 1.0);
        const std::vector<vec4> answers = draw(p, u);
        for (std::size_t i = 0; i < u.size(); ++i) {
            const dvec3 w = normalize(dvec3(answers[i]));
            by_angle.add(std::max(dot(w, normal), 0.0) * d(answers[i].w) / kPi);
            const dvec3 to = pointAt(p, p.shape == kTriangle && u[i].x + u[i].y > 1.0 ? 1.0 - u[i] : u[i]);
            const double r2 = dot(to, to);
            by_area.add(std::max(dot(to, normal), 0.0) * std::abs(dot(to, area)) / (r2 * r2 * kPi));
        }
        const double rounding =
            wanted * (angleBound(p) + 32.0 * kRounding);  // 32: the direction's, into its cosine
        EXPECT_NEAR(by_angle.value(), wanted, 4.5 * by_angle.error() + rounding) << name;
        EXPECT_NEAR(by_area.value(), wanted, 4.5 * by_area.error() + 1e-12) << name;
        return by_angle.error() / by_area.error();
    };
    const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    const auto near = [](double wanted, double digits) {
        return [=](double got) { return std::abs(got - wanted) <= 0.5 * digits; };
    };
    // Hottel and Sarofim 1967, Radiative Transfer: element to rectangle.
    EXPECT_TRUE(near(0.138532, 1e-6)(formFactor({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, z)));
    check("corner", rectangle({0, 0, 1}, x, y), z,
          formFactor({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, z));
    EXPECT_TRUE(near(0.554126, 1e-6)(formFactor({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, z)));
    check("centre", rectangle({-1, -1, 1}, 2.0 * x, 2.0 * y), z,
          formFactor({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, z));
    EXPECT_TRUE(near(0.0557342, 1e-7)(formFactor({{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, z)));
    check("upright", rectangle({0, 1, 0}, x, z), z,
          formFactor({{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, z));
    check("half", triangle({-1, -1, 1}, {1, -1, 1}, {1, 1, 1}), z,
          0.5 * formFactor({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, z));
    // Both sides of both ends of the range: the estimators agree there, so that switching between them shows
    // nothing.
    const dvec2 ends = limits();
    for (const double angle : {0.5 * ends.x, 2.0 * ends.x, ends.y - 0.02, ends.y + 0.02}) {
        const bool tiny = angle < 1.0;
        // A square of side 2 on the axis at distance h: tan(angle / 4) = 1 / (h sqrt(2 + h^2)).
        const double product = 1.0 / std::tan(0.25 * angle),
                     h = std::sqrt(std::sqrt(1.0 + product * product) - 1.0);
        const dvec3 normal = tiny ? normalize(dvec3(0.6, 0.3, 0.5)) : z;
        const Patch square = rectangle({-1, -1, h}, 2.0 * x, 2.0 * y);
        EXPECT_NEAR(solidAngle(square), angle, 1e-6 * angle);
        const dvec3 a = square.a, b = a + square.b, c = b + square.c, o = a + square.c;
        check("square of " + std::to_string(angle), square, normal, formFactor({a, b, c, o}, normal));
        // And a nearly equilateral triangle as large, its height found by bisection.
        double low = 1e-6, high = 1e6;
        const auto at = [&](double height) {
            return triangle({-1.7, -1, height}, {1.7, -1, height}, {0, 2, height});
        };
        for (int i = 0; i < 200; ++i)
            (solidAngle(at(std::sqrt(low * high))) > angle ? low : high) = std::sqrt(low * high);
        const Patch equal = at(low);
        check("triangle of " + std::to_string(angle), equal, normal,
              formFactor({equal.a, equal.b, equal.c}, normal));
    }
}

TEST_F(Spherical, cones) {
    std::vector<Question> questions;
    const auto cone = [&](double sin2, dvec2 u = dvec2(0.5)) {
        questions.push_back({vec4(static_cast<float>(sin2), 0, 0, 0), {}, {}, vec4(u.x, u.y, 0, 0)});
    };
    const double sun = 0.2666 * kPi / 180.0;
    const double half_angles[] = {sun, 1e-3, 1e-4, 1e-6, 0.5, 1.5, kPi / 2.0};
    for (const double angle : half_angles) cone(std::sin(angle) * std::sin(angle));
    std::vector<vec4> answers = ask(kCone, questions);
    EXPECT_NEAR(d(answers[0].w), 6.8018e-5, 0.5e-9);
    for (std::size_t i = 0; i < std::size(half_angles); ++i) {
        // From the square as fp32 holds it, in the double's own stable form.
        const double sin2 = d(questions[i].a.x), wanted = 2.0 * kPi * sin2 / (1.0 + std::sqrt(1.0 - sin2));
        EXPECT_NEAR(d(answers[i].w), wanted, 1e-6 * wanted) << half_angles[i];
        if (i < 6) {
            const double by_angle = 4.0 * kPi * std::pow(std::sin(0.5 * half_angles[i]), 2.0);
            EXPECT_NEAR(d(answers[i].w), by_angle, 1e-6 * by_angle) << half_angles[i];
        }
    }
    const std::vector<dvec2> u = uniformNumbers(kSamples, 17);
    for (const double sin2 : {1e-12, std::sin(sun) * std::sin(sun), 0.3, 1.0}) {
        questions.clear();
        for (const dvec2& numbers : u) cone(sin2, numbers);
        answers = ask(kCone, questions);
        Histogram cells(kSide, kSide);
        const double s2 = d(static_cast<float>(sin2)), height = s2 / (1.0 + std::sqrt(1.0 - s2));
        for (const vec4& w : answers) {
            ASSERT_NEAR(length(dvec3(w)), 1.0, 1e-6);
            // Of tiny cones z is all ones: the sideways part has the digits. 1 - cos = sin^2 / (1 + cos).
            const double out2 = d(w.x) * d(w.x) + d(w.y) * d(w.y);
            const double rise = w.z > 0.5F ? out2 / (1.0 + std::sqrt(1.0 - out2)) : 1.0 - d(w.z);
            ASSERT_LE(rise, height * (1.0 + 16.0 * kRounding));
            cells.add(rise / height, 0.5 + std::atan2(d(w.y), d(w.x)) / (2.0 * kPi));
        }
        expectLikely("cone " + std::to_string(sin2), cells.counts(), cells.uniform(), kChiSquares);
    }
}

// Diameters from the least that a light may have to half of all directions.
constexpr double kHalfAngles[] = {5e-6, 5e-5, 5e-4, 0.2666 * kPi / 180.0, 0.1, 1.0, kPi / 2.0};

dvec3 unitVector(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return normalize(dvec3(normal(random), normal(random), normal(random)));
}

// What says whether a direction is in a cone agrees with double precision but for a rim. In units of the
// cone's chord R that is 8 roundings wide, for the dot product and the cone's height, and where both lengths
// are off by 2^-24 the square of the chord grows by the square of their difference.
TEST_F(Spherical, insideOfConesEndsAtTheRim) {
    std::mt19937 random(23);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (const double angle : kHalfAngles) {
        const auto sin2 = static_cast<float>(std::sin(angle) * std::sin(angle));
        const double chord = std::sqrt(2.0 * d(sin2) / (1.0 + std::sqrt(1.0 - d(sin2))));
        std::vector<Question> questions;
        for (int i = 0; i < 1 << 14; ++i) {
            const vec3 axis(unitVector(random));
            const dvec3 side = normalize(cross(dvec3(axis), unitVector(random)));
            // A quarter of them within 1e-3 of the rim.
            const double at = i % 4 == 0 ? 1.0 + 2e-3 * (uniform(random) - 0.5) : 2.0 * uniform(random);
            const double turn = 2.0 * std::asin(std::min(0.5 * at * chord, 1.0));
            const dvec3 w = std::cos(turn) * normalize(dvec3(axis)) + std::sin(turn) * side;
            questions.push_back({vec4(sin2, 0, 0, 0), vec4(axis, 0), vec4(vec3(w), 0), {}});
        }
        const std::vector<vec4> answers = ask(kInsideCone, questions);
        const double rim = 8.0 * kRounding + 0.5 * std::pow(2.0 * kRounding / chord, 2.0);
        int decided = 0;
        for (std::size_t i = 0; i < answers.size(); ++i) {
            const dvec3 axis = normalize(dvec3(vec3(questions[i].b)));
            const double at = length(normalize(dvec3(vec3(questions[i].c))) - axis) / chord;
            if (std::abs(at - 1.0) <= rim) continue;
            ++decided;
            ASSERT_EQ(answers[i].w, at < 1.0 ? 1.0F : 0.0F) << angle << " at " << at;
        }
        EXPECT_GT(decided, 9 * (1 << 14) / 10) << angle;
    }
}

// What is drawn is inside, but for roundings: of a direction's components, half a unit of 2^-24 each when it
// is scaled and when it is summed, and 8 units of the part across, by frame and circle. Evenly spread
// directions lie that near the rim with twice its share of the radius.
TEST_F(Spherical, directionsDrawnInConesAreInside) {
    std::mt19937 random(29);
    const std::vector<dvec2> u = uniformNumbers(1U << 16U, 31);
    for (const double angle : kHalfAngles) {
        const auto sin2 = static_cast<float>(std::sin(angle) * std::sin(angle));
        const double chord = std::sqrt(2.0 * d(sin2) / (1.0 + std::sqrt(1.0 - d(sin2))));
        std::vector<Question> questions;
        for (const dvec2& numbers : u)
            questions.push_back({vec4(sin2, 0, 0, 0), vec4(vec3(unitVector(random)), 0), vec4(0),
                                 vec4(numbers.x, numbers.y, 0, 0)});
        double outside = 0.0;
        for (const vec4& answer : ask(kInsideCone, questions)) outside += answer.w == 0.0F ? 1.0 : 0.0;
        const double most = 2.0 * (kRounding / chord + 8.0 * kRounding) * static_cast<double>(u.size());
        RecordProperty("outside_" + std::to_string(angle),
                       std::to_string(outside / static_cast<double>(u.size())));
        EXPECT_LE(outside, most + 4.5 * std::sqrt(most)) << angle;
    }
}

TEST_F(Spherical, degenerateShapesGiveNothingAndNoNan) {
    const dvec3 o(0.0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    // No area, or seen edge on; the last two inside the shape's own plane.
    const std::vector<Patch> no_triangles{triangle(o, o, o),           triangle(x, x, x),
                                          triangle(x, y, y),           triangle(x, y, 0.5 * (x + y)),
                                          triangle(o, x, y),           triangle(x, 2.0 * x, 3.0 * x),
                                          triangle(-x, x, y),          triangle(x + y, 3.0 * x, y),
                                          triangle(-x - y, 2.0 * x, y)};
    const std::vector<Patch> no_rectangles{
        rectangle(o, o, o), rectangle(z, o, y),        rectangle(z, x, o), rectangle(z, o, o),
        rectangle(o, x, y), rectangle(-0.5 * x, x, y), rectangle(x, x, y), rectangle(-0.5 * (x + y), x, y),
        rectangle(-x, x, y)};
    // Grazing, touching, huge and small lengths: whatever the angle, it is a number up to 2 pi.
    const std::vector<Patch> odd_triangles{
        triangle(x + 1e-20 * z, y, -x - y), triangle(1e-20 * z, x, y), triangle(1e9 * x, 1e9 * y, 1e9 * z),
        triangle(1e-9 * x, 1e-9 * y, 1e-9 * z), triangle(-x + 1e-7 * z, x + 1e-7 * z, y + 1e-7 * z)};
    const std::vector<Patch> odd_rectangles{rectangle(-0.5 * (x + y) + 1e-20 * z, x, y),
                                            rectangle(1e-20 * z, x, y), rectangle(1e9 * z, 1e9 * x, 1e9 * y),
                                            rectangle(1e-9 * z, 1e-9 * x, 1e-9 * y),
                                            rectangle(1e5 * x + 1e-3 * z, x, 1e-4 * y)};
    constexpr double kLast = 1.0 - 0x1p-24;
    for (const dvec2 u : {dvec2(0.0), dvec2(0.5), dvec2(kLast), dvec2(0.0, kLast), dvec2(kLast, 0.0)}) {
        for (const auto* patches : {&no_triangles, &no_rectangles, &odd_triangles, &odd_rectangles}) {
            const std::vector<vec4> answers = ask(*patches, std::vector<dvec2>(patches->size(), u));
            const bool nothing = patches == &no_triangles || patches == &no_rectangles;
            for (std::size_t i = 0; i < answers.size(); ++i) {
                EXPECT_TRUE(finite(answers[i]))
                    << patches->at(i).shape << ' ' << i << " at " << u.x << ' ' << u.y;
                if (nothing)
                    EXPECT_EQ(answers[i].w, 0.0F) << patches->at(i).shape << ' ' << i;
                else
                    EXPECT_TRUE(answers[i].w >= 0.0F &&
                                d(answers[i].w) <= 2.0 * kPi * (1.0 + 8.0 * kRounding))
                        << i;
            }
        }
    }
}

}  // namespace
}  // namespace licht
