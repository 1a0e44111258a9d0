// What a file says of cameras, lights, sides and coverage, seen in a picture: closed forms, one small file
// each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "licht/core/error.h"
#include "licht/render/renderer.h"
#include "support/gltf_picture.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

using test::expectEverywhere;
using test::frontCamera;
using test::GltfPicture;
using test::Json;
using test::smallPicture;

constexpr double kRounding = 1e-5;
const Json kGlowing{{"emissiveFactor", {1, 1, 1}}};
constexpr DirectLight kEveryDirect[] = {DirectLight::mis, DirectLight::area, DirectLight::hemisphere};

/// A light of KHR_lights_punctual on a node of its own.
void addLight(GltfPicture& gltf, const Json& light, const Json& node) {
    gltf.file.json["extensions"]["KHR_lights_punctual"]["lights"].push_back(light);
    Json carrier{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
    carrier.merge_patch(node);
    gltf.file.root(carrier);
}

/// A white floor under one light 2 m above its middle, as far as (half, half), against the value at a place
/// of it. Of a pixel across which it falls from all to nothing so few samples tell little.
template <typename Exact>
void expectFloor(const Json& light, const Json& node, double half, const Exact& exact) {
    GltfPicture gltf;
    gltf.addQuad(GltfPicture::matte());
    addLight(gltf, light, node);
    const Film film = renderFilm(gltf.scene(), frontCamera(static_cast<float>(half)), smallPicture(), 64);
    int asked = 0;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            // Midpoints of the pixel: its offsets are as even.
            double mean = 0.0;
            double least = 1e9;
            double most = 0.0;
            for (int i = 0; i < 64; ++i) {
                const double value = exact(((x + (i % 8 + 0.5) / 8.0) / 8.0 - 1.0) * half,
                                           (1.0 - (y + (i / 8 + 0.5) / 8.0) / 8.0) * half);
                mean += value / 64.0;
                least = std::min(least, value);
                most = std::max(most, value);
            }
            if (most - least > 0.5 * most && most > 0.1) continue;
            ++asked;
            ASSERT_NEAR(static_cast<double>(film.mean.at(x, y, 0)), mean,
                        2e-3 * mean + 2e-2 * (most - least) + 1e-3 * exact(0.0, 0.0))
                << x << ' ' << y;
        }
    }
    EXPECT_GT(asked, 128);
}

double pointIrradiance(double x, double y, double candela) {
    const double distance2 = x * x + y * y + 4.0;
    return candela / std::numbers::pi / distance2 * (2.0 / std::sqrt(distance2));
}

// KHR_lights_punctual: candela over the square of the distance, cosine, a window of range.
TEST(GltfLight, PointFallsByTheSquare) {
    const Json above{{"translation", {0, 0, 2}}};
    expectFloor({{"type", "point"}, {"intensity", 10.0}}, above, 0.5,
                [](double x, double y) { return pointIrradiance(x, y, 10.0); });
    expectFloor({{"type", "point"}, {"intensity", 10.0}, {"range", 2.2}}, above, 0.5, [](double x, double y) {
        const double share = (x * x + y * y + 4.0) / (2.2 * 2.2);
        return pointIrradiance(x, y, 10.0) * std::max(0.0, 1.0 - share * share);
    });
}

// The cone: full inside of the inner angle, (cos - cos outer) / (cos inner - cos outer) squared, 0 beyond.
TEST(GltfLight, SpotFallsBetweenItsCones) {
    for (const auto& [inner, outer] : {std::pair{0.1, 0.25}, {0.0, 0.02}, {0.199, 0.2}, {0.005, 0.0087}}) {
        expectFloor(
            {{"type", "spot"},
             {"intensity", 10.0},
             {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}},
            {{"translation", {0, 0, 2}}}, 3.0 * outer, [inner = inner, outer = outer](double x, double y) {
                const double cosine = std::cos(std::atan(std::hypot(x, y) / 2.0));
                const double cone =
                    std::clamp((cosine - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
                return pointIrradiance(x, y, 10.0) * cone * cone;
            });
        if (HasFatalFailure()) return;
    }
}

// It shines along its node's -Z: turned by 60 degrees about X.
TEST(GltfLight, DirectionalGoesAlongItsNode) {
    const double half = std::numbers::pi / 6.0;
    expectFloor({{"type", "directional"}, {"intensity", std::numbers::pi}},
                {{"rotation", {std::sin(half), 0, 0, std::cos(half)}}}, 0.5,
                [](double, double) { return 0.5; });
}

/// Share of the picture that a glowing square of half side 0.5 covers for the file's camera, on a node at z
/// = 3.
double coverage(const Json& camera, uvec2 size) {
    GltfPicture gltf;
    gltf.addQuad(GltfPicture::matte(kGlowing), {{"scale", {0.5, 0.5, 1.0}}});
    gltf.file.root({{"camera", gltf.file.add("cameras", camera)}, {"translation", {0, 0, 3}}});
    const Scene scene = gltf.scene();
    RenderSettings settings = smallPicture();
    settings.size = size;
    return pictureMean(renderFilm(scene, scene.cameras.at(0), settings, 64), 3).mean;
}

// 3.10.3. Along each edge of the square some pixels are covered in part, to 1/64 of each.
TEST(GltfCamera, ShowsWhatItsNumbersSay) {
    const double tangent = std::tan(0.35);
    const double perspective = 0.5 / (3.0 * tangent);
    EXPECT_NEAR(
        coverage({{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}, uvec2(48, 24)),
        perspective * perspective / 2.0, 4e-3);
    EXPECT_NEAR(coverage({{"type", "orthographic"},
                          {"orthographic", {{"xmag", 1.6}, {"ymag", 0.8}, {"znear", 0.1}, {"zfar", 10.0}}}},
                         uvec2(48, 24)),
                0.25 / (1.6 * 0.8), 4e-3);
}

TEST(GltfCamera, SeesNothingBeyondItsPlanes) {
    for (const auto& [near, far, seen] : {std::tuple{0.1, 0.0, true},
                                          {0.1, 3.01, true},
                                          {0.1, 2.99, false},
                                          {2.99, 4.0, true},
                                          {3.01, 4.0, false}}) {
        Json planes{{"znear", near}};
        if (far > 0.0) planes["zfar"] = far;
        Json perspective = planes;
        perspective["yfov"] = 0.2;
        EXPECT_EQ(coverage({{"type", "perspective"}, {"perspective", perspective}}, uvec2(16)),
                  seen ? 1.0 : 0.0)
            << near << ' ' << far;
        if (far == 0.0) continue;
        planes["xmag"] = planes["ymag"] = 0.4;
        EXPECT_EQ(coverage({{"type", "orthographic"}, {"orthographic", planes}}, uvec2(16)), seen ? 1.0 : 0.0)
            << near << ' ' << far;
    }
}

// 3.7.4, 3.9.6: the front is where the triangle is counter-clockwise, turned over by a mirroring node, with
// and without a skin; the back of a single-sided surface is not there for the camera and gives no light.
TEST(GltfSides, FollowTheDeterminantOfTheNode) {
    for (const bool skinned : {false, true}) {
        for (const bool mirrored : {false, true}) {
            for (const bool double_sided : {false, true}) {
                GltfPicture gltf;
                Json material = GltfPicture::matte(kGlowing);
                material["doubleSided"] = double_sided;
                Json more = Json::object();
                if (skinned) {
                    more["JOINTS_0"] = gltf.file.accessor(std::vector<std::uint16_t>(16, 0),
                                                          test::kUnsignedShort, "VEC4", 4);
                    more["WEIGHTS_0"] = gltf.atEveryCorner({1, 0, 0, 0});
                }
                const int quad = gltf.addQuad(material, Json::object(), more);
                if (skinned) {
                    const int joint = gltf.file.add("nodes", Json{{"name", "joint"}});
                    gltf.file.json["nodes"].at(static_cast<std::size_t>(quad))["skin"] =
                        gltf.file.add("skins", {{"joints", {joint}}});
                    gltf.file.json["scenes"][0]["nodes"] = Json::array();
                    gltf.file.root({{"children", {quad, joint}}, {"scale", {mirrored ? -1 : 1, 1, 1}}});
                } else if (mirrored) {
                    gltf.file.json["nodes"].at(static_cast<std::size_t>(quad))["scale"] = {-1, 1, 1};
                }
                expectEverywhere(renderFilm(gltf.scene(), frontCamera(), smallPicture(), 1), glm::dvec3(1.0),
                                 kRounding);
                // From behind.
                Camera behind = frontCamera();
                behind.world_from_view =
                    mat4(vec4(-1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, -1, 0), vec4(0, 0, -3, 1));
                expectEverywhere(renderFilm(gltf.scene(), behind, smallPicture(), 1),
                                 glm::dvec3(double_sided ? 1.0 : 0.0), kRounding);
                if (HasFatalFailure()) return;
            }
        }
    }
}

/// The floor below a lamp of half side 0.7 at z = 1, by that estimator. The lamp faces up unless turned over.
Film floorBelow(const GltfPicture& gltf, DirectLight direct, std::uint32_t samples) {
    RenderSettings settings = smallPicture();
    settings.direct = direct;
    return renderFilm(gltf.scene(), frontCamera(0.5F, 0.5F), settings, samples);
}

void addLamp(GltfPicture& gltf, const Json& material, bool faces_down) {
    gltf.addQuad(GltfPicture::matte());
    Json node{{"translation", {0, 0, 1}}, {"scale", {0.7, 0.7, 0.7}}};
    if (faces_down) node["rotation"] = {1, 0, 0, 0};
    gltf.addQuad(material, node);
}

// 3.9.6: no light from the back of a single-sided lamp, whoever looks for it.
TEST(GltfSides, LampsShineFromTheirFrontAlone) {
    for (const DirectLight direct : kEveryDirect) {
        GltfPicture back;
        addLamp(back, GltfPicture::matte(kGlowing), false);
        expectEverywhere(floorBelow(back, direct, 4), glm::dvec3(0.0), 0.0);
        GltfPicture front;
        addLamp(front, GltfPicture::matte(kGlowing), true);
        GltfPicture both;
        Json double_sided = GltfPicture::matte(kGlowing);
        double_sided["doubleSided"] = true;
        addLamp(both, double_sided, false);
        const PictureMean a = pictureMean(floorBelow(front, direct, 256), 0);
        const PictureMean b = pictureMean(floorBelow(both, direct, 256), 0);
        EXPECT_GT(a.mean, 0.2);
        EXPECT_NEAR(a.mean, b.mean, 4.5 * std::hypot(a.standard_error, b.standard_error));
    }
}

// Every choice has the same mean, whatever covers the lamp: scattering alone, which asks whether the lamp is
// there as every other ray does, is the reference.
TEST(GltfLamps, GiveLightByTheirCoverage) {
    struct Cover {
        const char* name;
        Json material;
        int texture;  ///< 0: none, 1: alpha 0 and 255 side by side, 2: alpha 100
    };
    const auto factor = [](double alpha) {
        return Json{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}};
    };
    const auto with = [](Json a, const Json& b) {
        a.merge_patch(b);
        return a;
    };
    const Json mask{{"alphaMode", "MASK"}};
    const Json blend{{"alphaMode", "BLEND"}};
    for (const Cover& cover :
         {Cover{"opaque", factor(0.0), 0}, Cover{"masked away", with(mask, factor(0.3)), 0},
          Cover{"masked by half", mask, 1}, Cover{"blended", with(blend, factor(0.4)), 0},
          Cover{"blended away", with(blend, factor(0.0)), 0}, Cover{"blended by a texture", blend, 2}}) {
        double reference = 0.0;
        double reference_error = 0.0;
        for (const DirectLight direct : {DirectLight::hemisphere, DirectLight::mis, DirectLight::area}) {
            GltfPicture gltf;
            Json material = with(GltfPicture::matte(kGlowing), cover.material);
            if (cover.texture != 0) {
                const int texture = cover.texture == 1
                                        ? gltf.addTexture(2, 1, {{255, 255, 255, 0}, {255, 255, 255, 255}})
                                        : gltf.addTexture(1, 1, {{{255, 255, 255, 100}}});
                material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
            }
            addLamp(gltf, material, true);
            const PictureMean mean = pictureMean(floorBelow(gltf, direct, 256), 0);
            if (direct == DirectLight::hemisphere) {
                reference = mean.mean;
                reference_error = mean.standard_error;
            }
            EXPECT_NEAR(mean.mean, reference, 4.5 * std::hypot(mean.standard_error, reference_error) + 1e-5)
                << cover.name << ", estimator " << static_cast<int>(direct);
        }
    }
}

TEST(GltfCameras, TooNarrowForTheirPixelsAreRefused) {
    GltfPicture gltf;
    gltf.addQuad(GltfPicture::matte());
    const Scene scene = gltf.scene();
    Camera camera = frontCamera();
    camera.kind = Camera::Kind::perspective;
    RenderSettings settings = smallPicture();
    // Sixteen rows, each of 2^-23 radians: as fine as unit directions are.
    for (const float angle : {1e-30F, 15.9F * 0x1p-23F}) {
        camera.y_fov = angle;
        EXPECT_THROW(Renderer(gpu::testDevice(), scene, camera, settings), InputError) << angle;
    }
    camera.y_fov = 16.1F * 0x1p-23F;
    EXPECT_NO_THROW(Renderer(gpu::testDevice(), scene, camera, settings));
}

}  // namespace
}  // namespace licht
