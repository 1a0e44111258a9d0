// The light tree: probabilities that sum to one, hide nothing and are what the device does.
#include "licht/light/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "histogram.h"
#include "kernel.h"
#include "licht/shared/constants.h"
#include "licht/shared/index.h"
#include "licht/shared/light.h"
#include "licht/spirv/light_tree_comp.h"

namespace licht {
namespace {

using glm::dvec3;

class Dice {
public:
    explicit Dice(std::uint32_t seed) : random_(seed) {}
    double number() { return uniform_(random_); }
    dvec3 inBox(const dvec3& half) { return half * (2.0 * dvec3(number(), number(), number()) - 1.0); }
    dvec3 direction() {
        const double z = 2.0 * number() - 1.0;
        const double phi = 2.0 * std::numbers::pi * number();
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937 random_;
    std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

// A small flat emitter, a point or a spot.
LightBound randomLight(Dice& dice, const dvec3& half) {
    LightBound light;
    const dvec3 at = dice.inBox(half);
    const double kind = dice.number();
    const dvec3 size = kind < 0.7 ? dice.inBox(dvec3(0.2)) : dvec3(0.0);
    light.low = at - glm::abs(size);
    light.high = at + glm::abs(size);
    light.axis = dice.direction();
    light.normals_angle = kind < 0.7 ? 0.0 : kind < 0.85 ? std::numbers::pi : 0.0;
    light.emission_angle = kind < 0.85 ? 0.5 * std::numbers::pi : 0.1 + dice.number();
    light.intensity = std::exp(6.0 * dice.number() - 3.0);
    light.two_sided = kind < 0.2;
    return light;
}

std::vector<LightBound> randomLights(std::uint32_t seed, std::size_t count) {
    Dice dice(seed);
    std::vector<LightBound> lights;
    for (std::size_t i = 0; i < count; ++i) lights.push_back(randomLight(dice, {8, 3, 20}));
    return lights;
}

// Every other one glossy. Not seen at grazing angles nor very smooth, so that fp32 keeps the digits of the
// half vector's distance from the normal.
ShadingPoint randomPoint(Dice& dice, const dvec3& half, bool glossy) {
    ShadingPoint point{dice.inBox(half), dice.direction()};
    if (!glossy) return point;
    do point.wo = dice.direction();
    while (glm::dot(point.wo, point.normal) < 0.2);
    point.alpha = 0.1 + 0.4 * dice.number();
    point.specular = std::exp(4.0 * dice.number() - 2.0);
    return point;
}

double sumOfPmf(const LightTree& tree, const ShadingPoint& point) {
    double sum = 0.0;
    for (const uint trail : tree.trails) sum += lightTreePmf(tree, point, trail);
    return sum;
}

// Every leaf once, at the end of its trail.
void expectSoundTree(const LightTree& tree, std::size_t count) {
    ASSERT_EQ(tree.trails.size(), count);
    ASSERT_EQ(tree.children.size() % kLightChildren, 0U);
    ASSERT_LE(tree.children.size(), kLightChildren * (count - 1));
    std::vector<int> met(count);
    for (const LightChildRecord& child : tree.children)
        if (child.intensity > 0.0F && (child.next & kLightLeaf) != 0) ++met.at(child.next & kLightIndexMask);
    for (std::size_t light = 0; light < count; ++light) {
        ASSERT_EQ(met[light], 1) << light;
        uint trail = tree.trails[light];
        uint next = 0;
        for (int level = 0; level < 16 && (next & kLightLeaf) == 0; ++level, trail >>= kLightTrailBits)
            next =
                tree.children
                    .at(kLightChildren * std::size_t{next & kLightIndexMask} + (trail & (kLightChildren - 1)))
                    .next;
        ASSERT_NE(next & kLightLeaf, 0U) << light;
        ASSERT_EQ(next & kLightIndexMask, light);
    }
}

TEST(LightTree, leadsToEveryLight) {
    for (const std::size_t count : {2U, 3U, 17U, 1000U, 100'000U})
        expectSoundTree(buildLightTree(randomLights(1, count)), count);
}

// Spines would be deeper than a trail is long.
TEST(LightTree, isNeverDeeperThanItsTrails) {
    std::vector<LightBound> spine;
    Dice dice(2);
    for (int i = 0; i < 200; ++i) {
        LightBound light = randomLight(dice, dvec3(0.0));
        light.low = light.high = dvec3(std::exp2(-0.5 * i), 0, 0);
        light.intensity = std::exp2(0.5 * i);
        spine.push_back(light);
    }
    expectSoundTree(buildLightTree(spine), spine.size());
    const std::vector<LightBound> heap(100'000, spine.front());
    expectSoundTree(buildLightTree(heap), heap.size());
}

TEST(LightTree, probabilitiesSumToOne) {
    const LightTree tree = buildLightTree(randomLights(3, 300));
    Dice dice(4);
    double lost = 0.0;
    double unlit = 0.0;
    for (int i = 0; i < 300; ++i) {
        const ShadingPoint point = randomPoint(dice, {4, 2, 10}, i % 2 == 1);
        double sum = 0.0;
        for (const uint trail : tree.trails) {
            const double pmf = lightTreePmf(tree, point, trail);
            sum += pmf;
            unlit += pmf > 0.0 ? 0.0 : 1.0 / (300.0 * 300.0);
        }
        // 300 products of at most 16 factors in double precision. A walk may run into a node that promised
        // something and whose children are all dark: that share is lost, and none is ever added.
        EXPECT_LE(sum, 1.0 + 1e-12);
        lost += (1.0 - sum) / 300.0;
    }
    // Picking blindly loses the share of the lights that do not reach a point.
    EXPECT_LT(lost, 0.5 * unlit) << "bounds are too loose to be of use";
}

// What a light really sends to a point is bounded by zero only where the tree says so too: facing, horizon,
// cone.
TEST(LightTree, hidesNoLightThatReachesThePoint) {
    const std::vector<LightBound> lights = randomLights(5, 200);
    const LightTree tree = buildLightTree(lights);
    Dice dice(6);
    int reaching = 0;
    for (int i = 0; i < 400; ++i) {
        const ShadingPoint point = randomPoint(dice, {10, 4, 25}, i % 2 == 1);
        for (std::size_t k = 0; k < lights.size(); ++k) {
            const LightBound& light = lights[k];
            // Any point of the emitter's box may shine.
            const dvec3 from =
                light.low + dvec3(dice.number(), dice.number(), dice.number()) * (light.high - light.low);
            const dvec3 w = glm::normalize(from - point.position);
            double cos_emitter = -glm::dot(w, light.axis);
            if (light.two_sided) cos_emitter = std::abs(cos_emitter);
            const double angle =
                std::max(std::acos(std::clamp(cos_emitter, -1.0, 1.0)) - light.normals_angle, 0.0);
            if (glm::dot(w, point.normal) <= 0.0 || angle >= light.emission_angle) continue;
            ++reaching;
            ASSERT_GT(lightTreePmf(tree, point, tree.trails[k]), 0.0) << i << " " << k;
        }
    }
    EXPECT_GT(reaching, 10'000);
}

// Near lights first: the reason for the tree.
// As bright as floats go: their sum has no float, and their flux neither.
TEST(LightTree, holdsWhatIsAsBrightAsFloatsAre) {
    std::vector<LightBound> lights = randomLights(7, 40);
    const LightTree plain = buildLightTree(lights);
    for (LightBound& light : lights) light.intensity = std::ldexp(light.intensity, 126);
    const LightTree bright = buildLightTree(lights);
    const ShadingPoint point = {.position = dvec3(0.1, 0.2, 0.3), .normal = dvec3(0, 0, 1)};
    double sum = 0.0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(bright.trails[i], plain.trails[i]);
        const double pmf = lightTreePmf(bright, point, bright.trails[i]);
        EXPECT_EQ(pmf, lightTreePmf(plain, point, plain.trails[i]));
        sum += pmf;
    }
    EXPECT_GT(sum, 0.0);
}

TEST(LightTree, prefersWhatIsNearAndFacing) {
    std::vector<LightBound> row;
    for (int i = 0; i < 64; ++i) {
        LightBound light;
        light.low = light.high = dvec3(2.0 * i, 3, 0);
        light.axis = dvec3(0, i % 2 == 0 ? -1 : 1, 0);
        light.emission_angle = 0.5 * std::numbers::pi;
        light.intensity = 1.0;
        row.push_back(light);
    }
    const LightTree tree = buildLightTree(row);
    const dvec3 under(20, 0, 0);  // below light 10, which faces it
    EXPECT_GT(lightTreePmf(tree, {under, dvec3(0, 1, 0)}, tree.trails[10]), 5.0 / 64.0);
    EXPECT_EQ(lightTreePmf(tree, {under, dvec3(0, 1, 0)}, tree.trails[11]), 0.0) << "shines away";
    EXPECT_EQ(sumOfPmf(tree, {under, dvec3(0, -1, 0)}), 0.0) << "all lights lie below the horizon";
}

// What a specular layer shows comes first.
TEST(LightTree, prefersWhatACoatMirrors) {
    // Two lamps over a floor, alike but for the side; the eye sees the left one mirrored.
    std::vector<LightBound> pair(2);
    for (std::size_t i = 0; i < 2; ++i) {
        pair[i].low = pair[i].high = dvec3(i == 0 ? -3.0 : 3.0, 3.0, 0.0);
        pair[i].axis = dvec3(0, -1, 0);
        pair[i].emission_angle = 0.5 * std::numbers::pi;
        pair[i].intensity = 1.0;
    }
    const LightTree tree = buildLightTree(pair);
    ShadingPoint floor{dvec3(0.0), dvec3(0, 1, 0), glm::normalize(dvec3(1, 1, 0)), 0.1, 1.0};
    // The half vector is the normal for the left lamp and wo for the right one; pi D of both.
    const double base = std::sqrt(0.5);
    const double lobe = [&](double cos_h) {
        const double a2 = 0.01;
        const double below = a2 * cos_h * cos_h + 1.0 - cos_h * cos_h;
        return a2 / (below * below);
    }(base);
    EXPECT_NEAR(lightTreePmf(tree, floor, tree.trails[0]), (base + 100.0) / (2.0 * base + 100.0 + lobe),
                1e-4);
    floor.specular = 0.0;
    EXPECT_NEAR(lightTreePmf(tree, floor, tree.trails[0]), 0.5, 1e-9);
}

struct Place {
    vec3 position;
    float alpha = 0.0F;
    vec3 normal;
    float specular = 0.0F;
    vec3 wo;
    float reserved = 0.0F;
};

struct Answer {
    uint light;
    float pmf;
    float looked_up;
    uint reserved;
};

struct Push {
    std::uint32_t count;
    std::uint32_t per_place;
    std::uint32_t seed;
};

class OnDevice : public testing::TestWithParam<bool> {};

TEST_P(OnDevice, picksWithTheProbabilitiesThatItSays) {
    constexpr std::uint32_t kPerPlace = 1U << 17U;
    constexpr std::size_t kLights = 150;
    const LightTree tree = buildLightTree(randomLights(7, kLights));
    Dice dice(8);
    std::vector<Place> places;
    for (int i = 0; i < 8; ++i) {
        const ShadingPoint r = randomPoint(dice, {8, 3, 20}, i % 2 == 1);
        places.push_back({vec3(r.position), static_cast<float>(r.alpha), vec3(r.normal),
                          static_cast<float>(r.specular), vec3(r.wo)});
    }
    gpu::Device& device = gpu::testDevice();
    const gpu::Buffer records =
        gpu::uploadBuffer(device, "light_tree", std::span<const LightChildRecord>(tree.children),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    const gpu::TexelView texels(device, records, VK_FORMAT_R32G32B32A32_UINT);
    const gpu::Buffer trails = gpu::uploadBuffer(device, "trails", std::span<const uint>(tree.trails),
                                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    test::Kernel kernel("light tree", light_tree_comp, {{kConstantSceneInStorage, GetParam() ? 1U : 0U}});
    const auto count = static_cast<std::uint32_t>(places.size() * kPerPlace);
    const std::vector<Answer> answers =
        kernel.run<Answer>(count, count, Push{count, kPerPlace, 9}, places,
                           {{"LightTree", &records}, {"light_tree_texels", &texels}, {"Trails", &trails}});
    for (std::size_t p = 0; p < places.size(); ++p) {
        std::vector<double> expected;
        const Place& place = places[p];
        const ShadingPoint point{dvec3(place.position), dvec3(place.normal), dvec3(place.wo),
                                 static_cast<double>(place.alpha), static_cast<double>(place.specular)};
        double lit = 0.0;
        for (const uint trail : tree.trails) {
            expected.push_back(kPerPlace * lightTreePmf(tree, point, trail));
            lit += expected.back();
        }
        expected.push_back(std::max(kPerPlace - lit, 0.0));
        std::vector<std::uint64_t> observed(kLights + 1);
        for (std::size_t i = p * kPerPlace; i < (p + 1) * kPerPlace; ++i) {
            const Answer& a = answers[i];
            ++observed[a.light == kNoIndex ? kLights : a.light];
            if (a.light == kNoIndex) continue;
            // The same walk twice: the same operations in the same order.
            ASSERT_EQ(a.pmf, a.looked_up) << i;
            // An importance in fp32 is off by about 40 roundings, where a cosine is not small; one at the
            // slack of 1e-4 is off by 2^-24 * 40 / 1e-4 = 2.4 %. Two importances a level, at most 12 levels
            // here.
            const double exact = expected[a.light] / kPerPlace;
            ASSERT_NEAR(static_cast<double>(a.pmf), exact, 8 * 2 * 0.024 * exact) << i;
        }
        test::expectLikely("place " + std::to_string(p), observed, expected,
                           2 * static_cast<int>(places.size()));
    }
}

INSTANTIATE_TEST_SUITE_P(Memory, OnDevice, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "storage" : "texels"; });

}  // namespace
}  // namespace licht
