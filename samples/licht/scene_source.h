#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "licht/scene/scene.h"
#include "samples/licht/options.h"

namespace licht {

/// A built-in scene whose triangles can be counted out.
bool takesTriangles(const std::string& source);

/// A built-in scene or a file, by name, without what the request says of its light. Throws InputError when it
/// is neither, cannot be loaded or takes no count.
struct NamedScene {
    Scene scene;
    std::string name;  ///< built-in name, or the file's name without folder and ending
    bool builtin = false;
};
NamedScene loadNamedScene(const SceneRequest& request, double seconds = 0.0);

/// Whether it is another at another time.
bool moves(const NamedScene& source);

/// The scene as asked for, with its sky. A scene in which nothing gives light gets a neutral sky, unless a
/// sky was asked for; a note says so.
/// `seconds`: when, where it moves.
NamedScene loadScene(const SceneRequest& request, double seconds = 0.0);

/// Of the scene's cameras the one of that number or, where there is none, of that node's or its own name.
std::optional<std::size_t> findCamera(const Scene& scene, const std::string& wanted);

/// From where a scene is seen, and in which size.
struct Shot {
    Camera camera;
    std::string camera_name;  ///< its name or index; "framing" where the scene has none
    uvec2 size{0};
};
Shot chooseShot(const NamedScene& source, const std::optional<std::string>& camera,
                std::optional<SizeRequest> size);

/// Warnings of loading, one line each on stderr.
void printWarnings(const Scene& scene);

}  // namespace licht
