// A .glb.
#include "fuzz.h"
#include "gltf_seeds.h"

namespace licht::fuzz {

bool readInput(std::string_view bytes) {
    return loadScene(asFile("a.glb", bytes));
}

std::vector<std::string> seeds() {
    std::vector<std::string> files;
    for (const test::GltfFile& file : goodFiles())
        files.push_back(test::glb(file.withBuffer("").dump(), file.binary));
    return files;
}

}  // namespace licht::fuzz
