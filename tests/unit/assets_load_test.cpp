// Loads every model of the asset collection, where that is present: the environment variable LICHT_ASSETS
// names it, or it lies beside the source folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "licht/core/error.h"
#include "licht/scene/describe.h"
#include "licht/scene/gltf.h"

namespace licht {
namespace {

namespace fs = std::filesystem;

fs::path assetFolder() {
    if (const char* named = std::getenv("LICHT_ASSETS")) {
        return named;
    }
    return fs::path(LICHT_SOURCE) / ".." / "shared" / "assets";
}

/// The model's file in its plain variant; the compressed one where it has no other.
fs::path plainVariant(const fs::path& model) {
    for (const char* variant : {"glTF", "glTF-Binary", "glTF-Embedded"}) {
        for (const char* ending : {".gltf", ".glb"}) {
            const fs::path file = model / variant / (model.filename().string() + ending);
            if (fs::exists(file)) {
                return file;
            }
        }
    }
    return {};
}

std::string loadError(const fs::path& file) {
    try {
        loadGltf(file);
    } catch (const InputError& e) {
        return e.what();
    }
    return {};
}

TEST(Assets, EveryModelLoads) {
    const fs::path folder = assetFolder();
    if (!fs::is_directory(folder)) {
        std::cout << "no asset collection at " << folder << "; nothing to load\n";
        return;
    }
    std::size_t models = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const fs::path file = plainVariant(entry.path());
        if (file.empty()) {
            continue;
        }
        ++models;
        SCOPED_TRACE(file.string());
        Scene scene;
        ASSERT_NO_THROW(scene = loadGltf(file));
        EXPECT_NO_THROW(validateScene(scene));
        EXPECT_FALSE(sceneBounds(scene).empty());
        EXPECT_FALSE(scene.instances.empty());
        std::cout << describeSceneText(scene);
    }
    EXPECT_GT(models, 0U) << "a folder without models: " << folder;
}

TEST(Assets, CompressedVariantsAreRefusedByName) {
    const fs::path file = assetFolder() / "Box" / "glTF-Draco" / "Box.gltf";
    if (!fs::exists(file)) {
        std::cout << "no " << file << "; nothing to load\n";
        return;
    }
    EXPECT_EQ(loadError(file),
              file.string() + ": required extension 'KHR_draco_mesh_compression' is not supported");
}

}  // namespace
}  // namespace licht
