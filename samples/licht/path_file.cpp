#include "samples/licht/path_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/core/one_line.h"
#include "samples/licht/scene_source.h"

namespace licht {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 26U;

/// One key of a file, and where it stands there.
class KeyReader {
public:
    KeyReader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
        if (!json.is_object()) refuse("is no object");
        constexpr std::array<std::string_view, 7> kKnown{"time", "camera", "eye", "target",
                                                         "up",   "yfov",   "cut"};
        for (const auto& [name, value] : json.items())
            if (std::find(kKnown.begin(), kKnown.end(), name) == kKnown.end())
                refuse(fmt::format("has '{}', which is none of time, camera, eye, target, up, yfov, cut",
                                   oneLine(name)));
    }

    [[noreturn]] void refuse(std::string_view why) const {
        throw InputError(fmt::format("{} {}", where_, why));
    }
    [[nodiscard]] bool has(const char* name) const { return json_.contains(name); }
    [[nodiscard]] double number(const char* name) const {
        const Json& value = json_.at(name);
        // What a float cannot hold is no number here.
        if (!value.is_number() || !(std::abs(value.get<double>()) <= 1e30))
            refuse(fmt::format("has no finite number as '{}'", name));
        return value.get<double>();
    }
    [[nodiscard]] glm::dvec3 vector(const char* name) const {
        const Json& value = json_.at(name);
        if (!value.is_array() || value.size() != 3) refuse(fmt::format("has no three numbers as '{}'", name));
        glm::dvec3 result;
        for (int i = 0; i < 3; ++i) {
            const Json& part = value[static_cast<std::size_t>(i)];
            if (!part.is_number() || !(std::abs(part.get<double>()) <= 1e30))
                refuse(fmt::format("has no three finite numbers as '{}'", name));
            result[i] = part.get<double>();
        }
        return result;
    }
    [[nodiscard]] std::string text(const char* name) const {
        const Json& value = json_.at(name);
        if (value.is_number_unsigned()) return std::to_string(value.get<std::uint64_t>());
        if (!value.is_string()) refuse(fmt::format("has neither a name nor a number as '{}'", name));
        return value.get<std::string>();
    }
    [[nodiscard]] bool flag(const char* name) const {
        if (!has(name)) return false;
        if (!json_.at(name).is_boolean()) refuse(fmt::format("has neither true nor false as '{}'", name));
        return json_.at(name).get<bool>();
    }

private:
    const Json& json_;
    std::string where_;
};

/// origin: what of the file's world is the scene's.
mat4 worldFromView(const KeyReader& key, const glm::dvec3& origin) {
    const vec3 eye = key.vector("eye") - origin;
    const vec3 back = key.vector("eye") - key.vector("target");
    const vec3 up = key.has("up") ? vec3(key.vector("up")) : vec3(0.0F, 1.0F, 0.0F);
    const vec3 right = glm::cross(up, back);
    if (!(glm::dot(back, back) > 0.0F)) key.refuse("looks at its own eye");
    if (!(glm::dot(right, right) > 1e-12F * glm::dot(up, up) * glm::dot(back, back)))
        key.refuse("looks along its 'up'");
    const vec3 z = glm::normalize(back);
    const vec3 x = glm::normalize(right);
    return {vec4(x, 0.0F), vec4(glm::cross(z, x), 0.0F), vec4(z, 0.0F), vec4(eye, 1.0F)};
}

CameraKey readKey(const KeyReader& key, const Scene& scene, const Camera& start) {
    CameraKey result;
    if (!key.has("time")) key.refuse("has no 'time'");
    result.seconds = key.number("time");
    result.cut = key.flag("cut");
    result.camera = start;
    if (key.has("camera")) {
        if (key.has("eye") || key.has("target")) key.refuse("has both 'camera' and 'eye' or 'target'");
        const std::string name = key.text("camera");
        const std::optional<std::size_t> named = findCamera(scene, name);
        if (!named) key.refuse(fmt::format("asks for camera '{}', which is not there", name));
        result.camera = scene.cameras[*named];
    } else {
        if (!key.has("eye") || !key.has("target"))
            key.refuse("has neither 'camera' nor both 'eye' and 'target'");
        result.camera.world_from_view = worldFromView(key, scene.origin);
    }
    if (key.has("yfov")) {
        const double degrees = key.number("yfov");
        if (!(degrees > 0.0 && degrees < 180.0))
            key.refuse("has a 'yfov' that is not between 0 and 180 degrees");
        result.camera.y_fov = static_cast<float>(glm::radians(degrees));
    }
    if (result.camera.kind != start.kind) key.refuse("has another kind of camera than the path began with");
    return result;
}

/// The camera's axes without the scale or mirroring that a node may bring.
glm::quat turnOf(const Camera& camera) {
    const vec3 z = glm::normalize(vec3(camera.world_from_view[2]));
    const vec3 x = glm::normalize(glm::cross(vec3(camera.world_from_view[1]), z));
    return glm::quat_cast(mat3(x, glm::cross(z, x), z));
}

Camera between(const Camera& a, const Camera& b, float t) {
    Camera camera = a;
    const vec3 eye = glm::mix(vec3(a.world_from_view[3]), vec3(b.world_from_view[3]), t);
    camera.world_from_view = mat4(glm::mat3_cast(glm::slerp(turnOf(a), turnOf(b), t)));
    camera.world_from_view[3] = vec4(eye, 1.0F);
    camera.y_fov = glm::mix(a.y_fov, b.y_fov, t);
    camera.y_extent = glm::mix(a.y_extent, b.y_extent, t);
    return camera;
}

}  // namespace

CameraKeys::CameraKeys(std::vector<CameraKey> keys) : keys_(std::move(keys)) {
    assert(!keys_.empty());
}

Camera CameraKeys::at(double seconds) const {
    const auto behind = std::find_if(keys_.begin(), keys_.end(),
                                     [seconds](const CameraKey& key) { return key.seconds > seconds; });
    if (behind == keys_.begin()) return behind->camera;
    const CameraKey& before = *(behind - 1);
    if (behind == keys_.end() || behind->cut || before.seconds == seconds) return before.camera;
    return between(before.camera, behind->camera,
                   static_cast<float>((seconds - before.seconds) / (behind->seconds - before.seconds)));
}

bool CameraKeys::cutsBetween(double before, double seconds) const {
    return std::any_of(keys_.begin(), keys_.end(), [&](const CameraKey& key) {
        return key.cut && key.seconds > before && key.seconds <= seconds;
    });
}

CameraKeys readPathFile(const std::filesystem::path& path, const Scene& scene, const Camera& start) {
    const std::string name = path.string();
    const std::vector<std::byte> text = readFile(path, kMostBytes);
    const Json json = Json::parse(reinterpret_cast<const char*>(text.data()),
                                  reinterpret_cast<const char*>(text.data()) + text.size(), nullptr, false);
    if (json.is_discarded()) throw InputError(fmt::format("{}: is no JSON", name));
    if (!json.is_object() || !json.contains("keys") || !json["keys"].is_array() || json["keys"].empty())
        throw InputError(fmt::format("{}: has no list of 'keys' with at least one", name));
    std::vector<CameraKey> keys;
    for (const Json& key : json["keys"]) {
        const KeyReader reader(key, fmt::format("{}: keys[{}]", name, keys.size()));
        keys.push_back(readKey(reader, scene, start));
        if (keys.size() > 1 && !(keys.back().seconds > keys[keys.size() - 2].seconds))
            reader.refuse("is not later than the one before");
    }
    return CameraKeys(std::move(keys));
}

}  // namespace licht
