// What a file says of its materials, seen in a picture: closed forms, one small file each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "licht/colour/transfer.h"
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
using test::sunFrom;

/// Of fp32 through some dozen operations.
constexpr double kRounding = 1e-5;

Film pictureOf(const GltfPicture& gltf, const vec3& towards_sun = vec3(0, 0, 1), std::uint32_t samples = 2) {
    Scene scene = gltf.scene();
    if (towards_sun != vec3(0.0F)) scene.lights.push_back(sunFrom(towards_sun));
    return renderFilm(scene, frontCamera(), smallPicture(), samples);
}

glm::dvec3 decoded(const std::array<int, 4>& code) {
    glm::dvec3 linear;
    for (int c = 0; c < 3; ++c)
        linear[c] = static_cast<double>(
            linearFromSrgb(static_cast<float>(code[static_cast<std::size_t>(c)]) / 255.0F));
    return linear;
}

/// GGX with light, view and normal in one direction, under pi lx: D G F / 4 pi^-1 = F / (4 alpha^2).
double mirrorPeak(double f0, double roughness) {
    return f0 / (4.0 * std::pow(roughness, 4.0));
}

// 3.9.2, 3.7.2.1: factor, texture and vertex colour are multiplied; the texture alone is decoded.
TEST(GltfMaterial, BaseColourIsFactorTimesTextureTimesVertexColour) {
    GltfPicture gltf;
    const std::array<int, 4> code{200, 128, 20, 255};
    const int texture = gltf.addTexture(1, 1, {code});
    gltf.addQuad(GltfPicture::matte({{"pbrMetallicRoughness",
                                      {{"baseColorFactor", {0.8, 0.5, 1.0, 1.0}},
                                       {"baseColorTexture", {{"index", texture}}}}}}),
                 Json::object(), {{"COLOR_0", gltf.atEveryCorner({0.5F, 1.0F, 0.25F, 1.0F})}});
    const glm::dvec3 exact = decoded(code) * glm::dvec3(0.8, 0.5, 1.0) * glm::dvec3(0.5, 1.0, 0.25);
    expectEverywhere(pictureOf(gltf), exact, kRounding);
}

// 3.7.2.1. A sample lies anywhere in its pixel, so a colour is off by what half a pixel makes of it.
TEST(GltfMaterial, VertexColoursAreLinearBetweenCorners) {
    GltfPicture gltf;
    std::vector<float> colours;
    for (const auto& [x, y] : test::kQuadCorners)
        colours.insert(colours.end(), {0.5F + 0.5F * x, 0.5F + 0.5F * y, 1.0F, 1.0F});
    gltf.addQuad(GltfPicture::matte(), Json::object(), {{"COLOR_0", gltf.file.vec4s(colours)}});
    const Film film = pictureOf(gltf);
    constexpr double kPixel = 0.5 / 16.0;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const double right = 0.25 + kPixel * (x + 0.5);
            const double up = 0.75 - kPixel * (y + 0.5);
            ASSERT_NEAR(static_cast<double>(film.mean.at(x, y, 0)), right, 0.5 * kPixel + kRounding);
            ASSERT_NEAR(static_cast<double>(film.mean.at(x, y, 1)), up, 0.5 * kPixel + kRounding);
        }
    }
}

// 3.9.6: the back of a double-sided surface has the normal turned round. Turned by 120 degrees it is seen
// aslant, and lit from straight before it.
TEST(GltfMaterial, BacksFaceThoseWhoSeeThem) {
    GltfPicture gltf;
    const double half = std::numbers::pi / 3.0;
    gltf.addQuad(GltfPicture::matte({{"doubleSided", true}}),
                 {{"rotation", {0, std::sin(half), 0, std::cos(half)}}, {"scale", {4, 4, 4}}});
    const vec3 back(-std::sin(2.0 * half), 0.0, -std::cos(2.0 * half));
    expectEverywhere(pictureOf(gltf, back), glm::dvec3(1.0), kRounding);
}

// A shade of four panes behind the camera, of which the upper right one is open, and its shadow.
TEST(GltfMaterial, RaysPassHolesWhereTheirTexelsStand) {
    GltfPicture gltf;
    gltf.addQuad(GltfPicture::matte());
    const int panes = gltf.addTexture(
        2, 2, {{255, 255, 255, 255}, {255, 255, 255, 0}, {255, 255, 255, 255}, {255, 255, 255, 255}});
    gltf.addQuad(GltfPicture::matte({{"alphaMode", "MASK"},
                                     {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", panes}}}}}}),
                 {{"translation", {0, 0, 5}}});
    const Film film = pictureOf(gltf);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            const double lit = x >= 8 && y < 8 ? 1.0 : 0.0;
            ASSERT_NEAR(static_cast<double>(film.mean.at(x, y, 0)), lit, kRounding) << x << ' ' << y;
        }
    }
}

// 3.9.2: roughness in G, metalness in B, not decoded.
TEST(GltfMaterial, RoughnessIsGreenAndMetalnessIsBlue) {
    GltfPicture gltf;
    const int texture = gltf.addTexture(1, 1, {{{10, 204, 255, 255}}});
    gltf.addQuad({{"pbrMetallicRoughness",
                   {{"baseColorFactor", {0.9, 0.6, 0.3, 1.0}},
                    {"roughnessFactor", 0.9},
                    {"metallicRoughnessTexture", {{"index", texture}}}}}});
    const double peak = mirrorPeak(1.0, 0.9 * 204.0 / 255.0);
    expectEverywhere(pictureOf(gltf), peak * glm::dvec3(0.9, 0.6, 0.3), kRounding);
}

// KHR_materials_specular: f0 = min(0.04 * colour, 1) * factor, the factor by A, the colour decoded. Over
// black.
TEST(GltfMaterial, SpecularIsAlphaAndItsColourIsDecoded) {
    GltfPicture gltf;
    const std::array<int, 4> code{255, 188, 100, 255};
    const int factor = gltf.addTexture(1, 1, {{{0, 0, 0, 128}}});
    const int color = gltf.addTexture(1, 1, {code});
    gltf.addQuad({{"pbrMetallicRoughness",
                   {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.7}}},
                  {"extensions",
                   {{"KHR_materials_specular",
                     {{"specularFactor", 0.6},
                      {"specularTexture", {{"index", factor}}},
                      {"specularColorFactor", {1.0, 0.5, 2.0}},
                      {"specularColorTexture", {{"index", color}}}}}}}});
    const glm::dvec3 f0 = 0.04 * decoded(code) * glm::dvec3(1.0, 0.5, 2.0) * 0.6 * (128.0 / 255.0);
    expectEverywhere(pictureOf(gltf), mirrorPeak(1.0, 0.7) * f0, kRounding);
}

// KHR_materials_ior: 1.5 where nobody says, and 0 reflects all.
TEST(GltfMaterial, IorGivesTheReflectance) {
    for (const auto& [ior, f0] :
         {std::pair(Json{{"ior", 2.0}}, 1.0 / 9.0), {Json::object(), 0.04}, {Json{{"ior", 0.0}}, 1.0}}) {
        GltfPicture gltf;
        gltf.addQuad(
            {{"pbrMetallicRoughness",
              {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.7}}},
             {"extensions", {{"KHR_materials_ior", ior}}}});
        expectEverywhere(pictureOf(gltf), glm::dvec3(mirrorPeak(f0, 0.7)), kRounding);
    }
}

// KHR_materials_specular: colours may be brighter than white, and reflect no more than all there is.
TEST(GltfMaterial, BrightSpecularColoursReflectNoMoreThanAll) {
    GltfPicture gltf;
    gltf.addQuad({{"pbrMetallicRoughness",
                   {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.7}}},
                  {"extensions",
                   {{"KHR_materials_ior", {{"ior", 2.0}}},
                    {"KHR_materials_specular", {{"specularColorFactor", {18.0, 4.5, 1.0}}}}}}});
    expectEverywhere(pictureOf(gltf), mirrorPeak(1.0, 0.7) * glm::dvec3(1.0, 0.5, 1.0 / 9.0), kRounding);
}

// KHR_materials_clearcoat: factor by R, roughness by G. Over black, with no other layer.
TEST(GltfMaterial, ClearcoatIsRedAndItsRoughnessGreen) {
    GltfPicture gltf;
    const int factor = gltf.addTexture(1, 1, {{{128, 0, 0, 255}}});
    const int roughness = gltf.addTexture(1, 1, {{{0, 230, 0, 255}}});
    gltf.addQuad(GltfPicture::matte({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}},
                                     {"extensions",
                                      {{"KHR_materials_clearcoat",
                                        {{"clearcoatFactor", 0.7},
                                         {"clearcoatTexture", {{"index", factor}}},
                                         {"clearcoatRoughnessFactor", 0.9},
                                         {"clearcoatRoughnessTexture", {{"index", roughness}}}}}}}}));
    const double exact = 0.7 * 128.0 / 255.0 * mirrorPeak(0.04, 0.9 * 230.0 / 255.0);
    expectEverywhere(pictureOf(gltf), glm::dvec3(exact), kRounding);
}

// 3.9.3, KHR_materials_emissive_strength: no light is wanted for it.
TEST(GltfMaterial, EmissionIsFactorTimesTextureTimesStrength) {
    GltfPicture gltf;
    const std::array<int, 4> code{255, 188, 64, 0};
    const int texture = gltf.addTexture(1, 1, {code});
    gltf.addQuad(GltfPicture::matte(
        {{"emissiveFactor", {0.5, 1.0, 0.25}},
         {"emissiveTexture", {{"index", texture}}},
         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3.0}}}}}}));
    expectEverywhere(pictureOf(gltf, vec3(0.0F)), 3.0 * decoded(code) * glm::dvec3(0.5, 1.0, 0.25),
                     kRounding);
}

// KHR_materials_unlit: the base colour for the camera, and no light for anything else.
TEST(GltfMaterial, UnlitShowsItsColourAndLightsNothing) {
    GltfPicture gltf;
    const Json unlit{{"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.5, 0.8, 1.0}}}},
                     {"extensions", {{"KHR_materials_unlit", Json::object()}}},
                     {"doubleSided", true}};
    gltf.addQuad(unlit);
    expectEverywhere(pictureOf(gltf, vec3(0.0F)), glm::dvec3(0.2, 0.5, 0.8), kRounding);
    GltfPicture above;
    above.addQuad(GltfPicture::matte());
    above.addQuad(unlit, {{"translation", {0, 0, 1}}, {"scale", {3, 3, 1}}});
    for (const DirectLight direct : {DirectLight::mis, DirectLight::area, DirectLight::hemisphere}) {
        RenderSettings settings = smallPicture();
        settings.direct = direct;
        expectEverywhere(renderFilm(above.scene(), frontCamera(0.5F, 0.5F), settings, 4), glm::dvec3(0.0),
                         0.0);
    }
}

/// How a normal map's x and y go: by the texture's coordinates, or by given tangents of that handedness.
struct TangentSource {
    int handedness = 0;     ///< 0: none given
    bool mirrored = false;  ///< u runs to the left
};

/// The cosine towards the sun that glTF asks for (3.9.3): x along growing u, y against growing v, both times
/// scale.
double mappedCosine(const glm::dvec3& texel, double scale, const TangentSource& source,
                    const glm::dvec3& sun) {
    const double right = source.handedness == 0 && source.mirrored ? -1.0 : 1.0;
    const double up = source.handedness < 0 ? -1.0 : 1.0;
    const glm::dvec3 k = texel * 2.0 - 1.0;
    const glm::dvec3 n = glm::normalize(glm::dvec3(k.x * scale * right, k.y * scale * up, k.z));
    return glm::dot(n, glm::normalize(sun));
}

// The four quarters of the picture have the four signs.
TEST(GltfMaterial, NormalMapsGoByAllFourSignsAndScales) {
    const vec3 sun(0.3F, 0.2F, 1.0F);
    const std::vector<std::array<int, 4>> codes{
        {188, 168, 230, 255}, {68, 168, 230, 255}, {188, 88, 230, 255}, {68, 88, 230, 255}};
    for (const TangentSource& source : {TangentSource{}, {0, true}, {1, false}, {-1, false}}) {
        for (const double scale : {1.0, -0.7}) {
            GltfPicture gltf;
            const int texture = gltf.addTexture(2, 2, codes);
            Json more = Json::object();
            std::vector<float> uvs;
            for (const auto& [x, y] : test::kQuadCorners) {
                uvs.push_back(0.5F - 0.5F * x);
                uvs.push_back(0.5F - 0.5F * y);
            }
            if (source.handedness != 0)
                more["TANGENT"] = gltf.atEveryCorner({1, 0, 0, static_cast<float>(source.handedness)});
            if (source.mirrored) more["TEXCOORD_0"] = gltf.file.vec2s(uvs);
            gltf.addQuad(GltfPicture::matte({{"normalTexture", {{"index", texture}, {"scale", scale}}}}),
                         Json::object(), more);
            const Film film = pictureOf(gltf, sun, 1);
            for (int y = 0; y < 16; ++y) {
                for (int x = 0; x < 16; ++x) {
                    const std::array<int, 4>& code = codes[static_cast<std::size_t>(
                        ((x < 8) == source.mirrored ? 1 : 0) + (y < 8 ? 0 : 2))];
                    const double exact =
                        mappedCosine(glm::dvec3(code[0], code[1], code[2]) / 255.0, scale, source, sun);
                    ASSERT_NEAR(static_cast<double>(film.mean.at(x, y, 0)), exact, kRounding)
                        << "tangent " << source.handedness << ", mirrored " << source.mirrored << ", scale "
                        << scale << ", pixel " << x << ' ' << y;
                }
            }
        }
    }
}

// 3.7.2.1: a vertex that both sides of a mirrored texture share has two tangents, and nothing is interpolated
// between them. Left of the middle u runs to the left.
TEST(GltfMaterial, TangentsAreSplitWhereATextureIsMirrored) {
    GltfPicture gltf;
    const std::array<int, 4> code{220, 150, 200, 255};
    const int texture = gltf.addTexture(1, 1, {code});
    const int material =
        gltf.file.add("materials", GltfPicture::matte({{"normalTexture", {{"index", texture}}}}));
    const int positions = gltf.file.vec3s({-1, -1, 0, 0, -1, 0, 1, -1, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0});
    const int normals = gltf.file.vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int uvs = gltf.file.vec2s({1, 1, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0});
    gltf.file.root(
        {{"mesh",
          gltf.file.mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                          {"indices", gltf.file.indices({0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4})},
                          {"material", material}})}});
    const vec3 sun(0.4F, 0.1F, 1.0F);
    const Film film = pictureOf(gltf, sun, 1);
    const glm::dvec3 texel = glm::dvec3(code[0], code[1], code[2]) / 255.0;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) {
            if (x == 7 || x == 8) continue;  // their samples may be on either side
            const double exact = mappedCosine(texel, 1.0, {0, x < 8}, sun);
            ASSERT_NEAR(static_cast<double>(film.mean.at(x, y, 0)), exact, kRounding) << x << ", " << y;
        }
    }
}

// 3.7.2.1: without normals tangents MUST be ignored. The file's would turn the map by 90 degrees.
TEST(GltfMaterial, TangentsWithoutNormalsAreIgnored) {
    GltfPicture gltf;
    const std::array<int, 4> code{220, 150, 200, 255};
    const int texture = gltf.addTexture(1, 1, {code});
    gltf.addQuad(GltfPicture::matte({{"normalTexture", {{"index", texture}}}}), Json::object(),
                 {{"TANGENT", gltf.atEveryCorner({0, 1, 0, 1})}, {"NORMAL", nullptr}});
    const vec3 sun(0.4F, 0.1F, 1.0F);
    const double exact = mappedCosine(glm::dvec3(code[0], code[1], code[2]) / 255.0, 1.0, {}, sun);
    expectEverywhere(pictureOf(gltf, sun, 1), glm::dvec3(exact), kRounding);
}

// 3.9.4: MASK keeps what is at least the cutoff, also where alpha is interpolated from equal numbers; BLEND
// covers by alpha.
TEST(GltfMaterial, AlphaCovers) {
    const auto coverage = [](double factor, const Json& more, bool textured, std::uint32_t samples) {
        GltfPicture gltf;
        Json material =
            GltfPicture::matte({{"emissiveFactor", {1, 1, 1}},
                                {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, factor}}}}});
        material.merge_patch(more);
        Json attributes = Json::object();
        if (textured) {
            // Linear, at places all over the texel, and as vertex colours at places all over the triangle.
            const int texture = gltf.addTexture(2, 2, std::vector<std::array<int, 4>>(4, {255, 255, 255, 51}),
                                                {{"magFilter", 9729}});
            material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
            attributes["COLOR_0"] = gltf.file.vec4s(std::vector<float>(16, 1.0F));
        }
        gltf.addQuad(material, Json::object(), attributes);
        return pictureOf(gltf, vec3(0.0F), samples);
    };
    const Json mask{{"alphaMode", "MASK"}};
    expectEverywhere(coverage(0.5, mask, false, 4), glm::dvec3(1.0), kRounding);
    expectEverywhere(coverage(0.499, mask, false, 4), glm::dvec3(0.0), 0.0);
    expectEverywhere(coverage(0.499, Json::object(), false, 4), glm::dvec3(1.0), kRounding);
    expectEverywhere(coverage(1.0, {{"alphaMode", "MASK"}, {"alphaCutoff", 51.0F / 255.0F}}, true, 16),
                     glm::dvec3(1.0), kRounding);
    expectMean(coverage(0.25, {{"alphaMode", "BLEND"}}, false, 256), 0.25);
    expectMean(coverage(1.0, {{"alphaMode", "BLEND"}}, true, 256), 51.0 / 255.0);
}

/// Which texel of `size` a coordinate reads (3.8.4.4), by going there step by step.
int wrapped(double u, int size, int mode) {
    int i = static_cast<int>(std::floor(u * size));
    if (mode == 33071) return std::clamp(i, 0, size - 1);
    bool odd = false;
    for (; i < 0; i += size) odd = !odd;
    for (; i >= size; i -= size) odd = !odd;
    return mode == 33648 && odd ? size - 1 - i : i;
}

// 3.8.4, KHR_texture_transform, TEXCOORD_1: which texel stands where. Samples of a pixel lie anywhere in it,
// so only pixels that lie in one texel are asked.
TEST(GltfMaterial, TexelsStandWhereCoordinatesSay) {
    const std::vector<std::array<int, 4>> texels{{255, 0, 0, 255},   {0, 255, 0, 255},   {0, 0, 255, 255},
                                                 {255, 255, 0, 255}, {0, 255, 255, 255}, {255, 0, 255, 255}};
    int asked = 0;
    for (const auto& [wrap_s, wrap_t] : {std::pair{10497, 33071}, {33071, 33648}, {33648, 10497}}) {
        for (const double turn : {0.0, 0.4}) {
            GltfPicture gltf;
            const int texture = gltf.addTexture(3, 2, texels, {{"wrapS", wrap_s}, {"wrapT", wrap_t}});
            const glm::dvec2 offset(-0.8, 0.6);
            const glm::dvec2 scale(3.0, 2.5);
            std::vector<float> uvs;
            for (const auto& [x, y] : test::kQuadCorners) {
                uvs.push_back(0.5F + 0.5F * x);
                uvs.push_back(0.5F - 0.5F * y);
            }
            gltf.addQuad(GltfPicture::matte({{"emissiveFactor", {1, 1, 1}},
                                             {"emissiveTexture",
                                              {{"index", texture},
                                               {"texCoord", 0},
                                               {"extensions",
                                                {{"KHR_texture_transform",
                                                  {{"offset", {offset.x, offset.y}},
                                                   {"scale", {scale.x, scale.y}},
                                                   {"rotation", turn},
                                                   {"texCoord", 1}}}}}}}}),
                         Json::object(),
                         {{"TEXCOORD_0", gltf.file.vec2s(std::vector<float>(8, 0.25F))},
                          {"TEXCOORD_1", gltf.file.vec2s(uvs)}});
            const Film film = pictureOf(gltf, vec3(0.0F), 2);
            const auto texelAt = [&](double x, double y) {
                const glm::dvec2 uv = glm::dvec2(0.25 + 0.5 * x / 16.0, 0.25 + 0.5 * y / 16.0) * scale;
                // Counter-clockwise in the picture, where v grows downwards.
                const glm::dvec2 turned(std::cos(turn) * uv.x + std::sin(turn) * uv.y,
                                        -std::sin(turn) * uv.x + std::cos(turn) * uv.y);
                return wrapped(turned.x + offset.x, 3, wrap_s) + 3 * wrapped(turned.y + offset.y, 2, wrap_t);
            };
            for (int y = 0; y < 16; ++y) {
                for (int x = 0; x < 16; ++x) {
                    const int texel = texelAt(x + 0.5, y + 0.5);
                    bool inside = true;
                    for (int corner = 0; corner < 4; ++corner)
                        inside = inside && texelAt(x + corner % 2, y + corner / 2) == texel;
                    if (!inside) continue;
                    ++asked;
                    for (int c = 0; c < 3; ++c)
                        ASSERT_EQ(film.mean.at(x, y, c),
                                  texels[static_cast<std::size_t>(texel)][static_cast<std::size_t>(c)] > 0
                                      ? 1.0F
                                      : 0.0F)
                            << "wrap " << wrap_s << ' ' << wrap_t << ", turn " << turn << ", pixel " << x
                            << ' ' << y;
                }
            }
        }
    }
    EXPECT_GT(asked, 600);
}

// 3.8.4.2: linear between the centres of texels. Offsets fill a pixel evenly: of 64 each column of 1/64 has
// one.
TEST(GltfMaterial, LinearFilterIsLinearBetweenCentres) {
    GltfPicture gltf;
    const int texture = gltf.addTexture(2, 1, {{0, 0, 0, 255}, {255, 255, 255, 255}},
                                        {{"magFilter", 9729}, {"wrapS", 33071}});
    gltf.addQuad(
        GltfPicture::matte({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", texture}}}}));
    const Film film = renderFilm(gltf.scene(), frontCamera(1.0F), smallPicture(), 64);
    for (int x = 0; x < 16; ++x) {
        double exact = 0.0;
        for (int i = 0; i < 256; ++i)
            exact += std::clamp(2.0 * (x + (i + 0.5) / 256.0) / 16.0 - 0.5, 0.0, 1.0) / 256.0;
        ASSERT_NEAR(static_cast<double>(film.mean.at(x, 8, 0)), exact, 2.0 / 16.0 / 64.0) << x;
    }
}

// A hole among the sets: what is not there is read as 0 (3.7.2.1 asks for none), and nothing beyond an array.
TEST(GltfMaterial, MissingCoordinatesAreZero) {
    const std::vector<std::array<int, 4>> texels{{255, 0, 0, 255}, {0, 255, 0, 255}};
    for (const auto& [present, read] : {std::pair{1, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}}) {
        GltfPicture gltf;
        const int texture = gltf.addTexture(2, 1, texels);
        const std::string name = "TEXCOORD_" + std::to_string(present);
        const int uvs = gltf.file.vec2s(std::vector<float>(8, 0.75F));
        gltf.addQuad(GltfPicture::matte({{"emissiveFactor", {1, 1, 1}},
                                         {"emissiveTexture", {{"index", texture}, {"texCoord", read}}}}),
                     Json::object(), {{"TEXCOORD_0", nullptr}, {name, uvs}});
        const glm::dvec3 exact = present == read ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        expectEverywhere(pictureOf(gltf, vec3(0.0F), 1), exact, kRounding);
    }
}

Film filmOfIridescence(const Json& iridescence, const std::vector<std::array<int, 4>>& textures = {}) {
    GltfPicture gltf;
    for (const std::array<int, 4>& code : textures) gltf.addTexture(1, 1, {code});
    gltf.addQuad(
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {0.3, 0.2, 0.1, 1}}, {"metallicFactor", 1}, {"roughnessFactor", 0.5}}},
         {"extensions", {{"KHR_materials_iridescence", iridescence}}}});
    return pictureOf(gltf);
}

// KHR_materials_iridescence: the factor by R, the thickness between minimum and maximum by G, neither
// decoded; without a texture the thickness is the maximum. What a texture says is what the number would say.
TEST(GltfMaterial, IridescenceIsRedAndItsThicknessGreen) {
    const std::array<int, 4> code{204, 102, 255, 255};
    const Json by_texture{{"iridescenceFactor", 0.9},
                          {"iridescenceIor", 1.8},
                          {"iridescenceThicknessMinimum", 100},
                          {"iridescenceThicknessMaximum", 600},
                          {"iridescenceTexture", {{"index", 0}}},
                          {"iridescenceThicknessTexture", {{"index", 1}}}};
    const Json by_number{{"iridescenceFactor", 0.9 * 204.0 / 255.0},
                         {"iridescenceIor", 1.8},
                         {"iridescenceThicknessMinimum", 9},
                         {"iridescenceThicknessMaximum", 100.0 + 500.0 * 102.0 / 255.0}};
    const Film textured = filmOfIridescence(by_texture, {code, code});
    const Film plain = filmOfIridescence(by_number);
    const Film without = filmOfIridescence({{"iridescenceFactor", 0}});
    glm::dvec3 expected(0.0);
    for (int c = 0; c < 3; ++c) expected[c] = static_cast<double>(plain.mean.at(8, 8, c));
    expectEverywhere(textured, expected, kRounding);
    double change = 0.0;
    for (int c = 0; c < 3; ++c)
        change =
            std::max(change, std::abs(expected[c] / static_cast<double>(without.mean.at(8, 8, c)) - 1.0));
    EXPECT_GT(change, 0.1) << "a film that changes nothing would hide what its textures say";
}

TEST(GltfMaterial, TexturesOfIridescenceWithoutCoordinatesWarn) {
    GltfPicture gltf;
    gltf.addTexture(1, 1, {{255, 255, 255, 255}});
    gltf.addQuad(
        {{"extensions",
          {{"KHR_materials_iridescence",
            {{"iridescenceFactor", 1}, {"iridescenceThicknessTexture", {{"index", 0}, {"texCoord", 1}}}}}}}});
    const Scene scene = gltf.scene();
    ASSERT_EQ(scene.notes.size(), 1U);
    EXPECT_NE(scene.notes[0].text.find("TEXCOORD_1"), std::string::npos) << scene.notes[0].text;
}

}  // namespace
}  // namespace licht
