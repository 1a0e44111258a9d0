// Direct light by every way of finding it: one mean, which is known in closed form, and bounded noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "licht/film/film.h"
#include "licht/settings/settings.h"
#include "licht/shared/transfer.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin.h"
#include "samples/scenes/shapes.h"
#include "support/render_test.h"

namespace licht {
namespace {

constexpr double kPi = std::numbers::pi;

// Faces up, around the origin; ground below keeps what shines the lesser part of all surface.
void addReceiver(Scene& scene, float half) {
    place(scene, quadMesh("receiver", 0, vec3(-half, 0, half), vec3(half, 0, half), vec3(half, 0, -half),
                          vec3(-half, 0, -half)));
    place(scene, quadMesh("ground", 0, vec3(-9, -5, 9), vec3(9, -5, 9), vec3(9, -5, -9), vec3(-9, -5, -9)));
}

// A wall of side one over the receiver's edge x = -1/2, facing +X, from `pieces` x `pieces` quads.
void addWall(Scene& scene, int pieces) {
    const float step = 1.0F / static_cast<float>(pieces);
    for (int i = 0; i < pieces; ++i) {
        for (int j = 0; j < pieces; ++j) {
            const float z = 0.5F - step * static_cast<float>(i);
            const float y = step * static_cast<float>(j);
            place(scene, quadMesh("wall", 1, vec3(-0.5F, y, z), vec3(-0.5F, y, z - step),
                                  vec3(-0.5F, y + step, z - step), vec3(-0.5F, y + step, z)));
        }
    }
}

RenderSettings settingsOf(DirectLight direct, MisHeuristic mis, LightChoice lights) {
    RenderSettings settings;
    settings.size = uvec2(48);
    settings.bounces = 1;
    settings.direct = direct;
    settings.mis = mis;
    settings.lights = lights;
    settings.sampler = Sequence::random;
    return settings;
}

using Choice = std::tuple<DirectLight, MisHeuristic, LightChoice>;

class Estimators : public testing::TestWithParam<Choice> {};

// Howell, A Catalog of Radiation Heat Transfer Configuration Factors: perpendicular unit squares with a
// common edge.
TEST_P(Estimators, AgreeWithTheFormFactorOfATouchingWall) {
    const auto [direct, mis, lights] = GetParam();
    Scene scene;
    scene.materials = {lambert(0.5F), lambert(0.0F, 4.0F)};
    addReceiver(scene, 0.5F);
    addWall(scene, 4);
    const Film film =
        renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 3.0F), settingsOf(direct, mis, lights), 256);
    expectMean(film, 0.5 * 4.0 * 0.2000437761);
}

INSTANTIATE_TEST_SUITE_P(All, Estimators,
                         testing::Values(Choice{DirectLight::mis, MisHeuristic::power, LightChoice::tree},
                                         Choice{DirectLight::mis, MisHeuristic::balance, LightChoice::power},
                                         Choice{DirectLight::area, MisHeuristic::power, LightChoice::tree},
                                         Choice{DirectLight::area, MisHeuristic::power, LightChoice::uniform},
                                         Choice{DirectLight::hemisphere, MisHeuristic::power,
                                                LightChoice::tree}),
                         [](const auto& instance) { return "choice" + std::to_string(instance.index); });

// Mean over pixels of the variance of one sample.
double sampleVariance(const Film& film) {
    double sum = 0.0;
    for (std::size_t i = 0; i < film.variance.texels.size(); i += 3)
        sum += static_cast<double>(film.variance.texels[i]);
    return sum * film.samples / (static_cast<double>(film.size.x) * film.size.y);
}

// By area, the second moment of a touching light diverges (f^2 goes with r^-4). By solid angle a sample is
// worth albedo / pi * L * cos * omega, which is between 0 and 2 * albedo * L: its variance is at most the
// square of half of that (Popoviciu 1935), however near the surface is.
TEST(TouchingLight, HasBoundedVarianceAtAnyDistance) {
    for (const float strip : {0.1F, 1e-3F, 1e-5F}) {
        Scene scene;
        scene.materials = {lambert(0.5F), lambert(0.0F, 4.0F)};
        addReceiver(scene, 0.5F);
        addWall(scene, 1);
        const Camera camera = downCamera(vec3(-0.5F + 0.5F * strip, 0, 0), 0.5F * strip, 3.0F);
        const Film area = renderFilm(
            scene, camera, settingsOf(DirectLight::area, MisHeuristic::power, LightChoice::tree), 64);
        EXPECT_LE(sampleVariance(area), 0.5 * 0.5 * 4.0 * 4.0) << strip;
        // Rays start 2e-6 m off their surface here, and those of a strip as thin as that pass by the wall's
        // edge: means are compared where that is a share of at most 1e-3.
        if (strip < 1e-3F) continue;
        const Film hemisphere = renderFilm(
            scene, camera, settingsOf(DirectLight::hemisphere, MisHeuristic::power, LightChoice::tree), 64);
        const PictureMean a = pictureMean(area, 0), b = pictureMean(hemisphere, 0);
        EXPECT_LE(std::abs(a.mean - b.mean),
                  4.5 * std::hypot(a.standard_error, b.standard_error) + 1e-5 * b.mean)
            << strip;
    }
}

// Veach 1997, theorem 9.2, with one sample of each technique: the balance heuristic's variance exceeds that
// of the better technique alone by at most mu^2 / 2. A light that is small and far suits one of them, one
// that covers the sky the other.
TEST(Mis, IsNeverMuchWorseThanTheBetterOfBoth) {
    struct Light {
        float height, half;
    };
    for (const Light light : {Light{3.0F, 0.1F}, Light{0.2F, 2.0F}, Light{1.0F, 0.7F}}) {
        Scene scene;
        scene.materials = {lambert(0.5F), lambert(0.0F, 4.0F)};
        addReceiver(scene, 0.1F);
        const float h = light.half;
        const float y = light.height;
        place(scene, quadMesh("light", 1, vec3(-h, y, -h), vec3(h, y, -h), vec3(h, y, h), vec3(-h, y, h)));
        const Camera camera = downCamera(vec3(0.0F), 0.1F, 0.15F);
        const auto film = [&](DirectLight direct) {
            return renderFilm(scene, camera, settingsOf(direct, MisHeuristic::balance, LightChoice::tree),
                              64);
        };
        const Film mis = film(DirectLight::mis);
        const double best =
            std::min(sampleVariance(film(DirectLight::area)), sampleVariance(film(DirectLight::hemisphere)));
        const double mu = pictureMean(mis, 0).mean;
        // 2304 pixels of 64 samples know a variance to sqrt(2 / 147456) = 0.4 % for normal samples, and these
        // are bounded.
        EXPECT_LE(sampleVariance(mis), 1.05 * best + 0.5 * mu * mu) << light.height;
    }
}

/// Two texels side by side, nearest: the left one bright.
void addStripes(Scene& scene, std::uint32_t material) {
    Texture stripes;
    stripes.width = 2;
    stripes.height = 1;
    stripes.bits = 8;
    stripes.bytes = {255, 255, 255, 255, 0, 0, 0, 255};
    scene.textures = {stripes};
    scene.materials[material].slots[kSlotEmissive].texture = 0;
    scene.materials[material].slots[kSlotEmissive].linear = false;
}

enum class TinyShape { square, triangle, striped_triangle };

/// Over the origin at a height of 1, facing down; radiance times area is 4 whatever its side.
Scene tinyLight(TinyShape shape, float side) {
    // The triangle's u is 0 at one corner and 1 at the others: a quarter of it is bright.
    const float bright = shape == TinyShape::square ? 1.0F : shape == TinyShape::triangle ? 0.5F : 0.125F;
    Scene scene;
    scene.materials = {lambert(0.5F), lambert(0.0F, 4.0F / (bright * side * side))};
    addReceiver(scene, 0.001F);
    const float h = 0.5F * side;
    Mesh mesh = quadMesh("light", 1, vec3(-h, 1, -h), vec3(h, 1, -h), vec3(h, 1, h), vec3(-h, 1, h));
    if (shape != TinyShape::square) mesh.triangles.pop_back();
    if (shape == TinyShape::striped_triangle) addStripes(scene, 1);
    place(scene, std::move(mesh));
    return scene;
}

// At a fixed product of radiance and area a light's size does not matter once it is far away: E = L A / d^2,
// off by the square of size over distance; the way of sampling changes in between.
TEST(TinyLight, GivesWhatItsPowerSays) {
    for (const TinyShape shape : {TinyShape::square, TinyShape::triangle, TinyShape::striped_triangle}) {
        for (const float side : {1e-2F, 1e-3F, 3e-4F, 1e-5F}) {
            if (shape != TinyShape::square && side < 1e-2F && side > 1e-5F) continue;
            const Film film =
                renderFilm(tinyLight(shape, side), downCamera(vec3(0.0F), 0.001F, 0.5F),
                           settingsOf(DirectLight::mis, MisHeuristic::power, LightChoice::tree), 4);
            const double exact = 0.5 / kPi * 4.0;
            const PictureMean mean = pictureMean(film, 0);
            const double relative =
                2.0 * (static_cast<double>(side) * static_cast<double>(side) + 1e-6) + 1e-5;
            EXPECT_NEAR(mean.mean, exact, 4.5 * mean.standard_error + relative * exact)
                << static_cast<int>(shape) << " " << side;
        }
    }
}

// Half of the wall is dark: what is picked by the mean of the texture, and found by scattering, is one light.
TEST(TexturedLight, IsWhatScatteringFinds) {
    Scene scene;
    scene.materials = {lambert(0.5F), lambert(0.0F, 4.0F)};
    addStripes(scene, 1);
    addReceiver(scene, 0.5F);
    addWall(scene, 2);
    const Camera camera = downCamera(vec3(0.0F), 0.5F, 3.0F);
    // The stripes' mirror image is their complement, and the receiver is its own mirror image: half of the
    // whole wall.
    for (const DirectLight direct : {DirectLight::mis, DirectLight::area, DirectLight::hemisphere})
        expectMean(renderFilm(scene, camera, settingsOf(direct, MisHeuristic::power, LightChoice::tree), 128),
                   0.5 * 0.5 * 4.0 * 0.2000437761);
}

// What a colour of 16 bits says is decoded as one of 8 bits is.
TEST(TexturedLight, SixteenBitsAreDecoded) {
    constexpr std::uint32_t kValue = 40000;
    Texture gray;
    gray.width = gray.height = 1;
    gray.bits = 16;
    for (const std::uint32_t value : {kValue, kValue, kValue, 65535U})
        for (const std::uint32_t byte : {value & 255U, value >> 8U})
            gray.bytes.push_back(static_cast<std::uint8_t>(byte));
    Scene scene;
    scene.materials = {lambert(0.0F, 4.0F)};
    scene.textures = {gray};
    scene.materials[0].slots[kSlotEmissive].texture = 0;
    addReceiver(scene, 0.5F);
    const Film film = renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 3.0F),
                                 settingsOf(DirectLight::mis, MisHeuristic::power, LightChoice::tree), 1);
    const double exact = 4.0 * static_cast<double>(linearFromSrgb(kValue / 65535.0F));
    // A power of 2.4 in floats, as drivers have it.
    EXPECT_NEAR(pictureMean(film, 0).mean, exact, 1e-4 * exact);
}

// A directional light that fills `degrees` and gives 3 lx to a surface that faces it.
constexpr float kLux = 3.0F;
PunctualLight sunOf(double degrees, const vec3& direction = vec3(0, -1, 0)) {
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::directional;
    sun.direction = direction;
    sun.intensity = vec3(kLux);
    sun.angular_diameter = static_cast<float>(degrees * kPi / 180.0);
    return sun;
}

double radianceOfSun(double degrees) {
    const double sine = std::sin(0.5 * degrees * kPi / 180.0);
    return static_cast<double>(kLux) / (kPi * sine * sine);
}

// The receiver and nothing else above the ground, in one material.
Scene sunlit(const Material& material, std::vector<PunctualLight> suns) {
    Scene scene;
    scene.materials = {material};
    addReceiver(scene, 0.5F);
    scene.lights = std::move(suns);
    return scene;
}

RenderSettings sunSettings(DirectLight direct) {
    return settingsOf(direct, MisHeuristic::power, LightChoice::tree);
}

Film sunFilm(const Scene& scene, DirectLight direct, std::uint32_t samples = 64) {
    return renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 3.0F), sunSettings(direct), samples);
}

Material metal(float roughness) {
    Material m;
    m.metallic = 1.0F;
    m.roughness = roughness;
    return m;
}

constexpr DirectLight kEveryDirect[] = {DirectLight::mis, DirectLight::area, DirectLight::hemisphere};

// A directional light says what a surface that faces it gets, whatever part of the sky it fills. Scattering
// alone finds a small one too seldom to tell anything, and one that has no size not at all.
TEST(Sun, IlluminatesAlikeAtAnySize) {
    for (const double degrees : {0.0, 1e-3, 0.5332, 20.0, 120.0, 180.0}) {
        const Scene scene = sunlit(lambert(0.5F), {sunOf(degrees)});
        for (const DirectLight direct : kEveryDirect) {
            if (degrees < 20.0 && direct != DirectLight::mis) continue;
            SCOPED_TRACE(std::to_string(degrees) + " degrees, " + std::to_string(static_cast<int>(direct)));
            expectMean(sunFilm(scene, direct), 0.5 / kPi * 3.0);
        }
    }
}

// All of the sky at one radiance: scattering by the cosine is without noise.
TEST(Sun, OfHalfTheSkyIsAUniformSky) {
    const Film film = sunFilm(sunlit(lambert(1.0F), {sunOf(180.0)}), DirectLight::hemisphere, 4);
    for (std::size_t i = 0; i < film.mean.texels.size(); i += 4)
        ASSERT_NEAR(static_cast<double>(film.mean.texels[i]), 3.0 / kPi, 1e-6);
}

// Every light is an integral of its own, where they overlap too: two suns that share a half of each, 45
// degrees high, under a sky of 0.25. A cone that is all above the horizon gives what its axis says.
TEST(Sun, OverlappingSunsAndTheSkyAddUp) {
    const float r = std::sqrt(0.5F);
    Scene scene = sunlit(lambert(0.5F), {sunOf(60.0, vec3(r, -r, 0)), sunOf(40.0, vec3(0, -1, 0)),
                                         sunOf(0.0, vec3(0, -r, r))});
    scene.environment = constantEnvironment(vec3(0.25F));
    const double exact = 0.5 / kPi * 3.0 * (2.0 * std::sqrt(0.5) + 1.0) + 0.5 * 0.25;
    for (const DirectLight direct : kEveryDirect) expectMean(sunFilm(scene, direct, 128), exact);
}

// A mirror shows the disc as it is; its lobe of alpha = 1e-3 is far narrower than the sun. GGX has long
// tails: a reflection misses the disc where the half vector is tilted by more than a quarter of its diameter,
// which is alpha^2 / (alpha^2 + tan^2) of all. So every pixel is a whole number of samples that see the disc,
// and of the misses there are no more than the Poisson distribution of that mean gives in all but 1e-9.
TEST(Sun, IsSeenInAMirror) {
    const double exact = radianceOfSun(20.0);
    const Scene scene = sunlit(metal(0.0F), {sunOf(20.0)});
    const std::uint32_t samples = 4;
    const Film film = sunFilm(scene, DirectLight::hemisphere, samples);
    double missed = 0.0;
    for (std::size_t i = 0; i < film.mean.texels.size(); i += 4) {
        const double seen = static_cast<double>(film.mean.texels[i]) / exact * samples;
        ASSERT_NEAR(seen, std::round(seen), 1e-5 * samples);
        missed += samples - std::round(seen);
    }
    const double tan = std::tan(5.0 / 180.0 * kPi);
    const double pixels = static_cast<double>(film.mean.texels.size()) / 4.0;
    EXPECT_LE(missed, poissonQuantile(pixels * samples * 1e-6 / (1e-6 + tan * tan), 1e-9));
    expectMean(sunFilm(scene, DirectLight::mis), exact);
    // Beside the disc it is dark.
    const Film beside =
        sunFilm(sunlit(metal(0.0F), {sunOf(20.0, vec3(std::sqrt(0.5F), -std::sqrt(0.5F), 0))}),
                DirectLight::hemisphere, 4);
    for (std::size_t i = 0; i < beside.mean.texels.size(); i += 4) ASSERT_EQ(beside.mean.texels[i], 0.0F);
}

TEST(Sun, GlossySurfacesShowItAlikeByEveryEstimator) {
    const Scene scene = sunlit(metal(0.5F), {sunOf(30.0, glm::normalize(vec3(0.3F, -1, 0.1F)))});
    const PictureMean mis = pictureMean(sunFilm(scene, DirectLight::mis), 1);
    EXPECT_LT(mis.standard_error, 2e-3 * mis.mean) << "too noisy to tell anything";
    for (const DirectLight direct : {DirectLight::area, DirectLight::hemisphere}) {
        const PictureMean other = pictureMean(sunFilm(scene, direct), 1);
        EXPECT_LE(std::abs(mis.mean - other.mean), 4.5 * std::hypot(mis.standard_error, other.standard_error))
            << static_cast<int>(direct);
    }
}

// The camera sees the disc, opaque, and nothing beside it: each sample is all or nothing.
TEST(Sun, IsSeenByTheCamera) {
    constexpr double kDegrees = 20.0;
    const double disc = radianceOfSun(kDegrees);
    Camera camera;
    camera.y_fov = static_cast<float>(40.0 * kPi / 180.0);
    struct Case {
        float sky;
        DirectLight direct;
        bool queues;
    };
    for (const Case c : {Case{0.0F, DirectLight::mis, false}, Case{0.0F, DirectLight::area, true},
                         Case{0.25F, DirectLight::area, false}, Case{0.25F, DirectLight::hemisphere, true}}) {
        Scene scene;
        scene.lights = {sunOf(kDegrees, vec3(0, 0, 1))};
        if (c.sky > 0.0F) scene.environment = constantEnvironment(vec3(c.sky));
        RenderSettings settings = sunSettings(c.direct);
        settings.bounces = 0;
        settings.queues = c.queues;
        const Film film = renderFilm(scene, camera, settings, 1);
        double inside = 0.0;
        for (std::size_t i = 0; i < film.mean.texels.size(); i += 4) {
            const float value = film.mean.texels[i];
            const bool hit = value > c.sky;
            ASSERT_NEAR(static_cast<double>(value), static_cast<double>(c.sky) + (hit ? disc : 0.0),
                        1e-6 * disc);
            ASSERT_EQ(film.mean.texels[i + 3], hit || c.sky > 0.0F ? 1.0F : 0.0F);
            inside += hit ? 1.0 : 0.0;
        }
        // One point a pixel, at the same place in each: Gauss's circle problem, |error| <= 2 sqrt(2) pi r.
        const double radius = 48.0 * 0.5 * std::tan(10.0 * kPi / 180.0) / std::tan(20.0 * kPi / 180.0);
        EXPECT_NEAR(inside, kPi * radius * radius, 2.0 * std::sqrt(2.0) * kPi * radius);
    }
}

// The disc is order 0, what it lights is order 1, and the orders sum to the picture (orders_test says to how
// many roundings).
TEST(Sun, OrdersSumToThePicture) {
    Scene scene = sunlit(metal(0.3F), {sunOf(60.0, glm::normalize(vec3(0.2F, -1, 0.3F)))});
    scene.environment = constantEnvironment(vec3(0.1F));
    Camera camera;  // the horizon crosses the picture
    camera.y_fov = 2.0F;
    camera.world_from_view = glm::translate(mat4(1.0F), vec3(0, 0.05F, 0.6F));
    RenderSettings settings = sunSettings(DirectLight::mis);
    settings.bounces = 3;
    settings.orders = true;
    const Film film = renderFilm(scene, camera, settings, 8);
    ASSERT_EQ(film.orders.size(), 4U);
    float brightest = 0.0F;
    for (std::size_t i = 0; i < film.mean.texels.size(); ++i) {
        if (i % 4 == 3) continue;
        double sum = 0.0;
        for (const Image& order : film.orders) sum += static_cast<double>(order.texels[i / 4 * 3 + i % 4]);
        const auto mean = static_cast<double>(film.mean.texels[i]);
        ASSERT_NEAR(sum, mean, 32 * 6e-8 * mean);
        brightest = std::max(brightest, film.orders[0].texels[i / 4 * 3 + i % 4]);
    }
    EXPECT_NEAR(static_cast<double>(brightest), radianceOfSun(60.0) + 0.1, 1e-5);
}

// A bright cap in a dull sky: light sampling draws the cap alone where scattering is sampled as well, and all
// of the sky where it is not. By parts, E / pi = L(horizon) - integral of sin^2 dL; L falls linearly in the
// angle from the middle of the cap's last row to that of the next.
TEST(Sky, WhatStandsOutAndWhatDoesNotAddUp) {
    constexpr int kHeight = 32;
    constexpr int kRows = 8;
    constexpr double kCap = 6.0;
    constexpr double kRest = 0.5;
    Scene scene = sunlit(lambert(0.5F), {});
    Environment sky{"cap", Image(2 * kHeight, kHeight, 3)};
    for (std::size_t i = 0; i < sky.radiance.texels.size(); ++i)
        sky.radiance.texels[i] = static_cast<float>(i < std::size_t{3} * 2 * kHeight * kRows ? kCap : kRest);
    scene.environment = sky;
    const double a = (kRows - 0.5) * kPi / kHeight;
    const double b = (kRows + 0.5) * kPi / kHeight;
    const double mean_sine2 = 0.5 - 0.25 * (std::sin(2.0 * b) - std::sin(2.0 * a)) / (b - a);
    const double exact = 0.5 * (kRest + (kCap - kRest) * mean_sine2);
    for (const DirectLight direct : kEveryDirect) {
        for (const EnvironmentSampling how :
             {EnvironmentSampling::inversion, EnvironmentSampling::alias, EnvironmentSampling::rejection}) {
            SCOPED_TRACE(std::to_string(static_cast<int>(direct)) + ", " +
                         std::to_string(static_cast<int>(how)));
            RenderSettings settings = sunSettings(direct);
            settings.environment_sampling = how;
            expectMean(renderFilm(scene, downCamera(vec3(0.0F), 0.5F, 3.0F), settings, 64), exact);
        }
    }
}

// Many lights of many kinds: near, far, hidden, facing away, spots. Every choice among them has the same
// picture.
TEST(ManyLights, EveryChoiceGivesTheSamePicture) {
    const Scene scene = *makeBuiltinScene("lamps", 1000);
    RenderSettings settings = settingsOf(DirectLight::mis, MisHeuristic::power, LightChoice::tree);
    settings.size = uvec2(64, 36);
    settings.bounces = 2;
    const auto film = [&](LightChoice choice) {
        settings.lights = choice;
        ++settings.seed;
        return renderFilm(scene, scene.cameras[0], settings, 64);
    };
    const Film tree = film(LightChoice::tree);
    const Film power = film(LightChoice::power);
    const Film uniform = film(LightChoice::uniform);
    for (int c = 0; c < 3; ++c) {
        const PictureMean t = pictureMean(tree, c);
        for (const Film* other : {&power, &uniform}) {
            const PictureMean o = pictureMean(*other, c);
            EXPECT_LE(std::abs(t.mean - o.mean), 4.5 * std::hypot(t.standard_error, o.standard_error)) << c;
        }
    }
    EXPECT_LT(pictureMean(tree, 1).standard_error, pictureMean(uniform, 1).standard_error);
}

}  // namespace
}  // namespace licht
