// A PNG or JPEG in a good .glb.
#include "fuzz.h"
#include "gltf_seeds.h"

namespace licht::fuzz {

bool readInput(std::string_view bytes) {
    test::GltfFile file = test::GltfFile::triangle();
    const int uvs = file.vec2s({0, 0, 1, 0, 0, 1});
    file.primitive()["attributes"]["TEXCOORD_0"] = uvs;
    file.primitive()["material"] = 0;
    file.add("images", {{"bufferView", file.view(bytes)}, {"mimeType", "image/png"}});
    file.add("textures", {{"source", 0}});
    file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    return loadScene(asFile("a.glb", test::glb(file.withBuffer("").dump(), file.binary)), true);
}

std::vector<std::string> seeds() {
    return {smallPng(), smallJpeg()};
}

}  // namespace licht::fuzz
