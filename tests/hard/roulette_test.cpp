// Ending paths by chance keeps the mean, to what 1e8 paths can tell. In the suite 1e6 paths a picture, with
// LICHT_NIGHTLY=1 1e8.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <string>

#include "hard.h"
#include "licht/film/film.h"
#include "licht/settings/settings.h"
#include "pictures.h"

namespace licht {
namespace {

constexpr std::uint32_t kBounces = 5;

/// The inside of a sphere, in facets of these materials by turns.
Scene sphereInside(const std::vector<Material>& materials) {
    Scene scene;
    scene.materials = materials;
    const auto count = static_cast<std::uint32_t>(materials.size());
    for (std::uint32_t m = 0; m < count; ++m) {
        Mesh mesh = icosphereMesh("facets", m, 1.0F, 2);
        std::vector<uvec3> inward;
        for (std::size_t t = m; t < mesh.triangles.size(); t += count) {
            inward.push_back(uvec3(mesh.triangles[t].x, mesh.triangles[t].z, mesh.triangles[t].y));
        }
        mesh.triangles = inward;
        mesh.normals.clear();
        place(scene, std::move(mesh));
    }
    scene.cameras.push_back(lookingCamera("inside", vec3(0.3F, 0.1F, 0.2F), vec3(-1.0F, 0.2F, 0.0F), 1.5F));
    return scene;
}

std::uint32_t manySamples() {
    return static_cast<std::uint32_t>(test::often(16, 100));
}

Film film(const Scene& scene, std::uint32_t roulette_start, std::uint32_t samples = manySamples()) {
    RenderSettings settings;
    settings.size = uvec2(static_cast<std::uint32_t>(test::often(250, 1000)));
    settings.bounces = kBounces;
    settings.roulette_start = roulette_start;
    settings.sampler = Sequence::random;
    settings.seed = 11 + roulette_start;
    return renderFilm(scene, scene.cameras[0], settings, samples);
}

/// Of a picture's mean, relative: an order takes four roundings of 2^-24 at each bounce (the surface's
/// weight, twice for the roulette, the product) and one when it is added; the history's mean, in pairs of
/// floats, is rounded once at the end, and means of pixels are summed in double precision. All of one sign.
constexpr double kRoundings = (4.0 * kBounces + kBounces + 1.0) * 0x1p-24;

void report(const std::string& what, int channel, double z, double sigma) {
    std::cout << what << ", channel " << channel << ": z " << z << ", sigma " << sigma << '\n';
}

/// Both agree within four standard errors, which are what decides: roundings are below one of them.
void expectAlike(const std::string& what, const PictureMean& a, const PictureMean& b, int channel) {
    const double sigma = std::hypot(a.standard_error, b.standard_error);
    report(what, channel, (a.mean - b.mean) / sigma, sigma / b.mean);
    EXPECT_LT(kRoundings * b.mean, sigma) << what << ", channel " << channel;
    EXPECT_LE(std::abs(a.mean - b.mean), 4.0 * sigma + kRoundings * b.mean)
        << what << ", channel " << channel;
}

Material glowing(const vec3& albedo, const vec3& emission) {
    Material m = lambert(0.0F);
    m.base_color = vec4(albedo, 1.0F);
    m.emission = emission;
    return m;
}

// In a closed space that is the same everywhere, every path is worth Le (1 + r + r^2 + ...), in every form of
// it: without roulette there is no noise at all. The brightest colour decides who survives, and the others
// are carried beyond their own mean by it.
TEST(Roulette, KeepsWhatIsKnownInClosedForm) {
    struct Case {
        const char* name;
        vec3 albedo;
    };
    for (const Case& c : {Case{"colours", vec3(0.9F, 0.5F, 0.1F)}, Case{"dark", vec3(0.05F)}}) {
        const Scene scene = sphereInside({glowing(c.albedo, vec3(0.5F))});
        const Film never = film(scene, kBounces);
        const Film early = film(scene, 0);
        for (int channel = 0; channel < 3; ++channel) {
            const auto r = static_cast<double>(c.albedo[channel]);
            const PictureMean exact{0.5 * (1.0 - std::pow(r, kBounces + 1.0)) / (1.0 - r), 0.0};
            const PictureMean without = pictureMean(never, channel);
            EXPECT_LE(std::abs(without.mean - exact.mean),
                      4.0 * without.standard_error + kRoundings * exact.mean)
                << c.name << ", channel " << channel;
            const PictureMean with = pictureMean(early, channel);
            expectAlike(std::string(c.name) + ", closed form", with, exact, channel);
            expectAlike(std::string(c.name) + ", never", with, without, channel);
        }
    }
}

// However little a path carries, its chance is no larger than that: one in a thousand goes on here, and
// carries as much as the thousand did. With a least chance of two in a thousand the mean would be 16 standard
// errors too low.
TEST(Roulette, KeepsTheMeanWhereHardlyAnyPathGoesOn) {
    const double r = 0.001F;
    const Film early = film(sphereInside({glowing(vec3(0.001F), vec3(0.5F))}), 0);
    const PictureMean exact{0.5 * (1.0 - std::pow(r, kBounces + 1.0)) / (1.0 - r), 0.0};
    expectAlike("nearly black, closed form", pictureMean(early, 0), exact, 0);
}

// Surfaces that take all of one colour and half of the others: a chance by one colour alone would end every
// path that has none of it, and lose half of the others' light.
TEST(Roulette, EndsNoPathForTheLackOfOneColour) {
    for (int lacking = 0; lacking < 3; ++lacking) {
        vec3 albedo(0.5F);
        albedo[lacking] = 0.0F;
        const Film early = film(sphereInside({glowing(albedo, vec3(0.5F))}), 0, 2);
        const PictureMean exact{1.0 - std::pow(0.5, kBounces + 1.0), 0.0};
        for (int channel = 0; channel < 3; ++channel)
            if (channel != lacking)
                expectAlike("lacking " + std::to_string(lacking), pictureMean(early, channel), exact,
                            channel);
    }
}

// Light and dark facets side by side, a quarter of them lamps, so that lights are sampled too.
TEST(Roulette, KeepsTheMeanOfMixedSurfacesAndLamps) {
    const Material light = glowing(vec3(0.8F, 0.7F, 0.6F), vec3(0.0F));
    const Scene scene = sphereInside(
        {glowing(vec3(0.05F), vec3(1.0F)), light, glowing(vec3(0.05F, 0.1F, 0.4F), vec3(0.0F)), light});
    const Film never = film(scene, kBounces);
    const Film early = film(scene, 0);
    for (int channel = 0; channel < 3; ++channel) {
        expectAlike("mixed", pictureMean(early, channel), pictureMean(never, channel), channel);
    }
}

}  // namespace
}  // namespace licht
