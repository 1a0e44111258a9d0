// Where a scene lies, how large it is and how long directions are does not change what is hit.
#include <cmath>
#include <iostream>

#include "hard.h"

namespace licht {
namespace {

using test::Caster;
using test::Hits;
using test::OnBoth;
using test::Random;

/// A multiple of 2^-10 in [-half, half]: what translations by up to 2^13 keep exactly.
vec3 onGrid(Random& random, float half) {
    return glm::round(random.inCube(half) * 1024.0F) / 1024.0F;
}

struct Case {
    std::vector<BvhTriangle> triangles;
    std::vector<Ray> rays;
};

Case gridCase() {
    Random random(1);
    Case c;
    for (int i = 0; i < 1'000; ++i) {
        const vec3 at = onGrid(random, 1.0F);
        c.triangles.push_back(
            {at + onGrid(random, 0.2F), at + onGrid(random, 0.2F), at + onGrid(random, 0.2F)});
    }
    for (int i = 0; i < 20'000; ++i) {
        c.rays.push_back({onGrid(random, 1.5F), random.direction()});
    }
    return c;
}

class Invariance : public OnBoth {};

TEST_P(Invariance, TranslatedByPowersOfTwoTheHitsAreTheSame) {
    const Case c = gridCase();
    Caster caster(c.triangles, GetParam());
    const Hits expected = caster.nearest(c.rays);
    EXPECT_GT(c.rays.size() - test::missesOf(expected), c.rays.size() / 4);
    for (int k = 0; k <= 13; ++k) {
        const vec3 shift(std::ldexp(1.0F, k), -std::ldexp(1.0F, k), std::ldexp(1.0F, k));
        Case moved = c;
        for (BvhTriangle& t : moved.triangles) {
            t = {t.v0 + shift, t.v1 + shift, t.v2 + shift};
        }
        for (Ray& ray : moved.rays) {
            ray.origin += shift;
        }
        Caster there(moved.triangles, GetParam());
        EXPECT_EQ(test::differences(there.nearest(moved.rays), expected), 0U) << "by 2^" << k;
    }
}

TEST_P(Invariance, ScaledByPowersOfTwoTheHitsAreTheSame) {
    const Case c = gridCase();
    Caster caster(c.triangles, GetParam());
    const Hits unscaled = caster.nearest(c.rays);
    for (int k = -14; k <= 20; ++k) {
        const float scale = std::ldexp(1.0F, k);
        Case scaled = c;
        for (BvhTriangle& t : scaled.triangles) {
            t = {t.v0 * scale, t.v1 * scale, t.v2 * scale};
        }
        for (Ray& ray : scaled.rays) {
            ray.origin *= scale;
        }
        Hits expected = unscaled;
        for (auto& hit : expected) {
            if (hit) {
                hit->t *= scale;
            }
        }
        Caster there(scaled.triangles, GetParam());
        EXPECT_EQ(test::differences(there.nearest(scaled.rays), expected), 0U) << "by 2^" << k;
    }
}

// A sphere seen from outside, nowhere more than 30 degrees from its normals, so that the distance is well
// conditioned: turning a direction by the rounding of its components (2^-24) changes it by less than an ulp.
TEST_P(Invariance, DirectionsFrom1e_15To1e15GiveTheSameDistance) {
    Random random(2);
    std::vector<Ray> rays;
    for (int i = 0; i < 20'000; ++i) {
        const vec3 origin = 3.0F * random.direction();
        rays.push_back({origin, glm::normalize(random.inCube(0.25F) - origin)});
    }
    Caster caster(test::sphere(vec3(0.0F), 1.0F, 32, 64).triangles, GetParam());
    const Hits expected = caster.nearest(rays);
    ASSERT_EQ(test::missesOf(expected), 0U);
    double worst_of_all = 0.0;
    for (int decade = -15; decade <= 15; ++decade) {
        const auto length = static_cast<float>(std::pow(10.0, decade));
        std::vector<Ray> stretched = rays;
        for (Ray& ray : stretched) {
            ray.direction *= length;
        }
        const Hits hits = caster.nearest(stretched);
        ASSERT_EQ(test::missesOf(hits), 0U) << "length 1e" << decade;
        double worst = 0.0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const auto t = static_cast<double>(expected[i]->t);
            const double scaled = static_cast<double>(hits[i]->t) * static_cast<double>(length);
            worst = std::max(worst, std::abs(scaled - t) / (t * 0x1p-23));
        }
        EXPECT_LE(worst, 8.0) << "length 1e" << decade;
        worst_of_all = std::max(worst_of_all, worst);
    }
    std::cout << "largest difference " << worst_of_all << " ulp\n";
}

INSTANTIATE_TEST_SUITE_P(Hard, Invariance, testing::Values(test::Where::host, test::Where::device),
                         test::nameOfWhere);

}  // namespace
}  // namespace licht
