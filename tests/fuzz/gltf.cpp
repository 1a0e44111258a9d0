// A .gltf with everything in it.
#include "fuzz.h"
#include "gltf_seeds.h"

namespace licht::fuzz {

bool readInput(std::string_view bytes) {
    return loadScene(asFile("a.gltf", bytes));
}

std::vector<std::string> seeds() {
    std::vector<std::string> texts;
    for (const test::GltfFile& file : goodFiles())
        texts.push_back(
            file.withBuffer("data:application/octet-stream;base64," + test::base64(file.binary)).dump());
    return texts;
}

}  // namespace licht::fuzz
