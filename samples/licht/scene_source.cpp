#include "samples/licht/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

#include "licht/core/error.h"
#include "licht/image/files.h"
#include "licht/scene/gltf.h"
#include "samples/licht/outputs.h"
#include "samples/licht/text.h"
#include "samples/scenes/builtin.h"

namespace licht {
namespace {

constexpr std::uint32_t kDefaultHeight = 540;
constexpr std::uint32_t kTestSceneHeight = 512;
constexpr double kDefaultAspect = 16.0 / 9.0;

/// The square test scenes are drawn at the size their references have.
bool isTestScene(const NamedScene& source) {
    return source.builtin && (source.name == "cornell" || source.name == "furnace");
}

[[noreturn]] void refuseScene(const std::string& source) {
    std::error_code ignored;
    const std::filesystem::path path(source);
    if (std::filesystem::is_directory(path, ignored))
        throw InputError(fmt::format("{}: is a folder, not a scene", source));
    if (std::filesystem::exists(path, ignored))
        throw InputError(fmt::format("{}: a scene file ends in .gltf or .glb", source));
    std::string names;
    for (const BuiltinScene& scene : builtinScenes())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", scene.name);
    throw InputError(
        fmt::format("{}: no such scene: neither a .gltf or .glb file nor built in ({})", source, names));
}

std::string cameraWords(const Camera& camera) {
    return camera.node.empty() || camera.node == camera.name
               ? fmt::format("'{}'", camera.name)
               : fmt::format("'{}' on '{}'", camera.name, camera.node);
}

[[noreturn]] void refuseCamera(const NamedScene& source, const std::string& wanted) {
    std::string known;
    for (std::size_t i = 0; i < source.scene.cameras.size(); ++i)
        known += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, cameraWords(source.scene.cameras[i]));
    throw InputError(fmt::format("{}: no camera '{}'; the scene has {}", source.name, wanted,
                                 known.empty() ? "none" : known));
}

/// Width over height.
double defaultAspect(const NamedScene& source, const Camera* camera) {
    if (isTestScene(source)) return 1.0;
    if (camera == nullptr || !(camera->aspect > 0.0F)) return kDefaultAspect;
    return static_cast<double>(camera->aspect);
}

/// What is not said of a size follows from the camera.
uvec2 completeSize(SizeRequest size, double aspect) {
    const auto side = [](double pixels) {
        return static_cast<std::uint32_t>(std::clamp(std::round(pixels), 1.0, double{kMaxPictureSide}));
    };
    if (size.width == 0) size.width = side(size.height * aspect);
    if (size.height == 0) size.height = side(size.width / aspect);
    if (std::uint64_t{size.width} * size.height > kMaxPicturePixels)
        throw InputError(
            fmt::format("--size: {}x{} are more than {} pixels", size.width, size.height, kMaxPicturePixels));
    return {size.width, size.height};
}

std::string scenesThatCount() {
    std::string names;
    for (const BuiltinScene& scene : builtinScenes())
        if (scene.triangles > 0) names += fmt::format("{}{}", names.empty() ? "" : ", ", scene.name);
    return names;
}

}  // namespace

std::optional<std::size_t> findCamera(const Scene& scene, const std::string& wanted) {
    std::size_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto [stop, error] = std::from_chars(wanted.data(), end, index);
    if (error == std::errc{} && stop == end && index < scene.cameras.size()) return index;
    for (const auto member : {&Camera::node, &Camera::name}) {
        const auto named = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                        [&](const Camera& camera) { return camera.*member == wanted; });
        if (named != scene.cameras.end()) return static_cast<std::size_t>(named - scene.cameras.begin());
    }
    return std::nullopt;
}

bool takesTriangles(const std::string& source) {
    const auto& scenes = builtinScenes();
    return std::any_of(scenes.begin(), scenes.end(), [&](const BuiltinScene& scene) {
        return scene.name == source && scene.triangles > 0;
    });
}

bool moves(const NamedScene& source) {
    const auto& scenes = builtinScenes();
    return source.builtin && std::any_of(scenes.begin(), scenes.end(), [&](const BuiltinScene& scene) {
               return scene.name == source.name && scene.moves;
           });
}

NamedScene loadNamedScene(const SceneRequest& request, double seconds) {
    const std::string& source = request.scene;
    const std::uint64_t triangles = request.triangles;
    if (triangles > 0 && !takesTriangles(source))
        throw InputError(fmt::format("--triangles: '{}' has triangles of its own; a count is for: {}", source,
                                     scenesThatCount()));
    if (auto builtin = makeBuiltinScene(source, triangles, seconds))
        return {std::move(*builtin), source, true};
    const std::filesystem::path path(source);
    const std::string ending = lowerCase(path.extension().string());
    if (ending != ".gltf" && ending != ".glb") refuseScene(source);
    return {loadGltf(path, {.strict = request.strict}), path.stem().string(), false};
}

namespace {

/// Of the sky that is there, whoever brought it.
void turnSky(Scene& scene, double degrees) {
    if (!scene.environment) throw InputError("--environment-rotation: the scene has no sky to turn");
    const double turns = degrees / 360.0;
    const auto turn = static_cast<float>(turns - std::floor(turns));
    scene.environment->turn = turn < 1.0F ? turn : 0.0F;
}

void strengthenSky(Scene& scene, double factor) {
    if (!scene.environment) throw InputError("--environment-strength: the scene has no sky");
    for (float& value : scene.environment->radiance.texels) {
        const double stronger = static_cast<double>(value) * factor;
        if (stronger > static_cast<double>(std::numeric_limits<float>::max()))
            throw InputError(fmt::format("--environment-strength {}: a texel of {} cd/m^2 grows out of range",
                                         factor, value));
        value = static_cast<float>(stronger);
    }
}

}  // namespace

NamedScene loadScene(const SceneRequest& request, double seconds) {
    NamedScene source = loadNamedScene(request, seconds);
    Scene& scene = source.scene;
    if (request.environment) {
        std::size_t replaced = 0;
        scene.environment =
            Environment{*request.environment, readRadianceMap(*request.environment, &replaced)};
        if (replaced > 0)
            scene.notes.push_back({SceneNote::Kind::warning,
                                   fmt::format("{}: {} texels that were negative or not finite became 0",
                                               *request.environment, replaced)});
    } else if (request.background) {
        scene.environment = constantEnvironment(*request.background);
    } else if (isDark(scene)) {
        const bool dim = brightestEmission(scene) > 0.0F;
        scene.environment = constantEnvironment(vec3(1.0F));
        scene.notes.push_back({SceneNote::Kind::warning,
                               fmt::format("{} in the scene gives light: lit by a neutral sky of 1 cd/m^2",
                                           dim ? "nothing bright enough to see" : "nothing")});
    }
    if (request.environment_rotation) turnSky(scene, *request.environment_rotation);
    if (request.environment_strength) strengthenSky(scene, *request.environment_strength);
    if (request.sun_angle)
        for (PunctualLight& light : scene.lights)
            light.angular_diameter = glm::radians(static_cast<float>(*request.sun_angle));
    return source;
}

Shot chooseShot(const NamedScene& source, const std::optional<std::string>& camera,
                std::optional<SizeRequest> size) {
    const Scene& scene = source.scene;
    std::optional<std::size_t> index;
    if (camera) {
        index = findCamera(scene, *camera);
        if (!index) refuseCamera(source, *camera);
    } else if (!scene.cameras.empty()) {
        index = 0;
    }
    Shot shot;
    const SizeRequest by_default{0, isTestScene(source) ? kTestSceneHeight : kDefaultHeight};
    shot.size = completeSize(size.value_or(by_default),
                             defaultAspect(source, index ? &scene.cameras[*index] : nullptr));
    if (index) {
        shot.camera = scene.cameras[*index];
        shot.camera_name = shot.camera.name.empty() ? std::to_string(*index) : shot.camera.name;
    } else {
        shot.camera = framingCamera(sceneBounds(scene),
                                    static_cast<float>(shot.size.x) / static_cast<float>(shot.size.y));
        shot.camera_name = "framing";
    }
    return shot;
}

void printWarnings(const Scene& scene) {
    for (const SceneNote& note : scene.notes)
        if (note.kind == SceneNote::Kind::warning)
            printError(fmt::format("licht: warning: {}\n", oneLine(note.text)));
}

}  // namespace licht
