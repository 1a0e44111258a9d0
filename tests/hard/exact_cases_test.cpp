// Single rays whose answer is known by hand: ranges, flat boxes, slivers.
#include <cmath>
#include <iostream>

#include "hard.h"

namespace licht {
namespace {

using test::Caster;
using test::Hits;
using test::Random;

class Exact : public test::OnBoth {};

// unit/intersect_test has this for the host by hand; here the device says the same, for any-hit too.
TEST_P(Exact, TheRangeIsHalfOpen) {
    Caster caster({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}, GetParam());
    const vec3 down(0, 0, -1);
    const float after = std::nextafter(4.0F, 5.0F);
    const std::vector<Ray> rays{
        {{1, 1, 4}, down, 4.0F},       {{1, 1, 4}, down, 0.0F, after}, {{1, 1, 0}, down},  // hit
        {{1, 1, 4}, down, after},      {{1, 1, 4}, down, 0.0F, 4.0F},  {{1, 1, 0}, down, 0.0F, 0.0F},
        {{1, 1, 4}, down, after, 4.0F}};
    for (const Hits& hits : {caster.nearest(rays), caster.any(rays)}) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(hits[i].has_value(), i < 3) << i;
        }
    }
    const Hits nearest = caster.nearest(rays);
    EXPECT_EQ(nearest[0]->t, 4.0F);
    EXPECT_EQ(nearest[2]->t, 0.0F);
}

// Walls whose boxes are flat; rays in their planes, on their edges and corners, the other components +0 or
// -0.
TEST_P(Exact, AxisParallelRaysInThePlanesOfFlatBoxes) {
    std::vector<BvhTriangle> triangles;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                const auto corner = [&](int a, int b) {
                    vec3 p(0.0F);
                    p[axis] = static_cast<float>(i);
                    p[(axis + 1) % 3] = static_cast<float>(j + a);
                    p[(axis + 2) % 3] = static_cast<float>(b);
                    return p;
                };
                triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
                triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
            }
        }
    }
    std::vector<Ray> rays;
    for (int axis = 0; axis < 3; ++axis) {
        for (int signs = 0; signs < 8; ++signs) {
            for (int i = -1; i <= 9; ++i) {
                for (int j = -1; j <= 9; ++j) {
                    Ray ray;
                    ray.direction = vec3((signs & 1) != 0 ? -0.0F : 0.0F, (signs & 2) != 0 ? -0.0F : 0.0F,
                                         (signs & 4) != 0 ? -0.0F : 0.0F);
                    ray.direction[axis] = std::copysign(1.0F, ray.direction[axis]);
                    ray.origin[axis] = -6.0F * ray.direction[axis];
                    ray.origin[(axis + 1) % 3] = 0.5F * static_cast<float>(i);
                    ray.origin[(axis + 2) % 3] = 0.5F * static_cast<float>(j);
                    rays.push_back(ray);
                }
            }
        }
    }
    Caster caster(triangles, GetParam());
    Hits expected;
    for (const Ray& ray : rays) {
        expected.push_back(intersectBruteForce(triangles, ray));
    }
    EXPECT_GT(rays.size() - test::missesOf(expected), 500U);
    const Hits found = caster.nearest(rays);
    EXPECT_EQ(test::differences(found, expected), 0U);
}

// A triangle whose corners lie on one line is no surface (the case is of PBRT's tests).
TEST_P(Exact, ATriangleThatIsALineIsMissed) {
    Caster caster({{{-1113.45459F, -79.049614F, -56.2431908F},
                    {-1113.45459F, -87.0922699F, -56.2431908F},
                    {-1113.45459F, -79.2090149F, -56.2431908F}}},
                  GetParam());
    EXPECT_EQ(caster.bvh().dropped, 1U);
    const Ray ray{
        {-1081.47925F, 99.9999542F, 87.7701111F}, {-32.1072998F, -183.355865F, -144.607635F}, 0.0F, 0.9999F};
    EXPECT_EQ(test::missesOf(caster.nearest({ray})), 1U);
}

// A parallelogram of 1 x 1e-3 cut into 2000 slivers of aspect 1e6, leaning so that their boxes overlap. Rays
// down a lattice over four times its area hit exactly where it is; the share of hits is its area.
TEST_P(Exact, AStripOfSliversHasItsArea) {
    constexpr int kSlivers = 1'000;
    // Leaning by 1e-5 over a length of one takes each sliver across ten others. Near zero, y keeps 2^-24 of
    // itself: the area is off by 1e-7.
    const auto corner = [](double x, double y) { return vec3(x, y + 1e-5 * x, 0.5 * x + 0.25 * y); };
    std::vector<BvhTriangle> triangles;
    for (int i = 0; i < kSlivers; ++i) {
        const double y0 = 1e-6 * i;
        const double y1 = 1e-6 * (i + 1);
        triangles.push_back({corner(0, y0), corner(1, y0), corner(1, y1)});
        triangles.push_back({corner(0, y0), corner(1, y1), corner(0, y1)});
    }
    // A rank-1 lattice with the golden ratio, whose error falls like log(n) / n.
    const std::size_t count = test::often(400'000, 10'000'000);
    std::size_t inside = 0;
    std::size_t holes = 0;
    std::vector<Ray> rays;
    std::vector<bool> deep;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * 2.0 - 0.5;
        const double y = std::fmod(static_cast<double>(i) * 0.6180339887498949, 1.0) * 2e-3 - 5e-4;
        const vec3 on = corner(x, y);
        rays.push_back({vec3(on.x, on.y, 4.0F), vec3(0, 0, -1)});
        deep.push_back(x > 1e-6 && x < 1.0 - 1e-6 && y > 1e-9 && y < 1e-3 - 1e-9);
    }
    Caster caster(triangles, GetParam());
    const Hits hits = caster.nearest(rays);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        inside += hits[i] ? 1U : 0U;
        holes += deep[i] && !hits[i] ? 1U : 0U;
    }
    EXPECT_EQ(caster.bvh().dropped, 0U);
    EXPECT_EQ(holes, 0U);
    const double area = 4.0 * static_cast<double>(inside) / static_cast<double>(count);
    std::cout << "area " << area << " of 1\n";
    EXPECT_NEAR(area, 1.0, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Hard, Exact, testing::Values(test::Where::host, test::Where::device),
                         test::nameOfWhere);

}  // namespace
}  // namespace licht
