// Every model of a folder of glTF samples, where there is one: it renders, no sample is no number, and the
// picture is not black.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "licht/film/film.h"
#include "licht/scene/gltf.h"
#include "licht/settings/settings.h"
#include "support/render_test.h"

namespace licht {
namespace {

namespace fs = std::filesystem;

fs::path assetFolder() {
    const char* folder = std::getenv("LICHT_ASSETS");
    return folder != nullptr ? folder : LICHT_ASSET_FOLDER;
}

// The plain variant of a model: compressed ones need extensions that are not read.
fs::path modelFile(const fs::path& folder) {
    for (const char* variant : {"glTF", "glTF-Binary", "glTF-Embedded", "glTF-Quantized"}) {
        if (!fs::is_directory(folder / variant)) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / variant))
            if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
                return entry.path();
    }
    return {};
}

TEST(Assets, EveryModelRenders) {
    const fs::path assets = assetFolder();
    if (!fs::is_directory(assets)) {
        std::cout << "no models to render: the folder " << assets
                  << " is not there (LICHT_ASSETS names another)\n";
        return;
    }
    std::size_t rendered = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(assets)) {
        const fs::path file = entry.is_directory() ? modelFile(entry.path()) : fs::path();
        if (file.empty()) continue;
        SCOPED_TRACE(file.string());
        Scene scene;
        try {
            scene = loadGltf(file);
        } catch (const std::exception& error) {
            // BoxMeshopt exists in compressed form alone.
            EXPECT_NE(std::string(error.what()).find("required extension"), std::string::npos)
                << error.what();
            continue;
        }
        if (isDark(scene)) scene.environment = constantEnvironment(vec3(1.0F));
        RenderSettings settings;
        settings.size = uvec2(48, 32);
        const Camera camera =
            scene.cameras.empty() ? framingCamera(sceneBounds(scene), 1.5F) : scene.cameras[0];
        const Film film = renderFilm(scene, camera, settings, 4);
        EXPECT_GT(pictureMean(film, 0).mean + pictureMean(film, 1).mean + pictureMean(film, 2).mean, 0.0)
            << "all black";
        ++rendered;
    }
    std::cout << rendered << " models rendered\n";
    EXPECT_GT(rendered, 0U);
}

}  // namespace
}  // namespace licht
