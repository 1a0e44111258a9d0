#include "support/gltf_picture.h"

#include <gtest/gtest.h>

#include "licht/image/files.h"
#include "licht/scene/gltf.h"

namespace licht::test {

int GltfPicture::addQuad(const Json& material, const Json& node, const Json& more) {
    std::vector<float> positions;
    std::vector<float> normals;
    std::vector<float> uvs;
    for (const auto& [x, y] : kQuadCorners) {
        positions.insert(positions.end(), {x, y, 0.0F});
        normals.insert(normals.end(), {0.0F, 0.0F, 1.0F});
        uvs.insert(uvs.end(), {0.5F + 0.5F * x, 0.5F - 0.5F * y});
    }
    Json attributes{{"POSITION", file.vec3s(positions)},
                    {"NORMAL", file.vec3s(normals)},
                    {"TEXCOORD_0", file.vec2s(uvs)}};
    attributes.merge_patch(more);
    const int mesh = file.mesh({{"attributes", attributes},
                                {"indices", file.indices({0, 1, 2, 0, 2, 3})},
                                {"material", file.add("materials", material)}});
    Json placed{{"mesh", mesh}};
    placed.merge_patch(node);
    return file.root(placed);
}

int GltfPicture::atEveryCorner(const std::array<float, 4>& value) {
    std::vector<float> values;
    for (std::size_t corner = 0; corner < kQuadCorners.size(); ++corner)
        for (const float component : value) values.push_back(component);
    return file.vec4s(values);
}

int GltfPicture::addTexture(int width, int height, const std::vector<std::array<int, 4>>& texels,
                            const Json& sampler) {
    Image image(width, height, 4);
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        image.texels[i] = static_cast<float>(texels[i / 4][i % 4]) / 255.0F;
    const std::string name = "image" + std::to_string(images_++) + ".png";
    writePng(folder_.path() / name, image);
    Json nearest{{"magFilter", 9728}};
    nearest.merge_patch(sampler);
    return file.add("textures", {{"source", file.add("images", {{"uri", name}})},
                                 {"sampler", file.add("samplers", nearest)}});
}

Json GltfPicture::matte(const Json& more) {
    Json material{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
                  {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0.0}}}}}};
    material.merge_patch(more);
    return material;
}

Scene GltfPicture::scene() const {
    return loadGltf(file.writeExternal(folder_));
}

Camera frontCamera(float half, float height) {
    Camera camera;
    camera.kind = Camera::Kind::orthographic;
    camera.y_extent = half;
    camera.world_from_view[3] = vec4(0, 0, height, 1);
    return camera;
}

PunctualLight sunFrom(const vec3& towards) {
    PunctualLight sun;
    sun.kind = PunctualLight::Kind::directional;
    sun.direction = -glm::normalize(towards);
    sun.intensity = vec3(kPi);
    return sun;
}

RenderSettings smallPicture() {
    RenderSettings settings;
    settings.size = uvec2(16);
    settings.bounces = 1;
    // What glTF's own formulas say has a closed form.
    settings.layering = Layering::gltf;
    settings.energy = Energy::single;
    return settings;
}

void expectEverywhere(const Film& film, const glm::dvec3& exact, double share) {
    for (int y = 0; y < film.mean.height; ++y)
        for (int x = 0; x < film.mean.width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(static_cast<double>(film.mean.at(x, y, c)), exact[c], share * exact[c] + 1e-7)
                    << "pixel " << x << ", " << y << ", channel " << c;
}

}  // namespace licht::test
