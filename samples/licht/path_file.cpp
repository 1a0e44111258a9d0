#include "samples/licht/path_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/core/one_line.h"
#include "samples/licht/scene_source.h"

namespace licht {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 26U;
/// Of coordinates, metres, and of times, seconds: squares of floats beyond have no floats.
constexpr double kLargest = 1e15;

bool isUsable(const Json& value) {
    return value.is_number() && std::abs(value.get<double>()) <= kLargest;
}

/// Of an object, a member that it may not have.
std::optional<std::string> strangerIn(const Json& object, std::span<const std::string_view> known) {
    for (const auto& [name, value] : object.items())
        if (std::find(known.begin(), known.end(), name) == known.end())
            return fmt::format("has '{}', which is none of {}", oneLine(name), fmt::join(known, ", "));
    return std::nullopt;
}

/// One key of a file, and where it stands there.
class KeyReader {
public:
    KeyReader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
        if (!json.is_object()) refuse("is no object");
        constexpr std::array<std::string_view, 7> kKnown{"time", "camera", "eye", "target",
                                                         "up",   "yfov",   "cut"};
        if (const auto stranger = strangerIn(json, kKnown)) refuse(*stranger);
    }

    [[noreturn]] void refuse(std::string_view why) const {
        throw InputError(fmt::format("{} {}", where_, why));
    }
    [[nodiscard]] bool has(const char* name) const { return json_.contains(name); }
    [[nodiscard]] double number(const char* name) const {
        const Json& value = json_.at(name);
        if (!isUsable(value)) refuse(fmt::format("has no number up to {:g} as '{}'", kLargest, name));
        return value.get<double>();
    }
    [[nodiscard]] glm::dvec3 vector(const char* name) const {
        const Json& value = json_.at(name);
        if (!value.is_array() || value.size() != 3 || !std::all_of(value.begin(), value.end(), isUsable))
            refuse(fmt::format("has no three numbers up to {:g} as '{}'", kLargest, name));
        return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
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
    const glm::dvec3 eye = key.vector("eye");
    const glm::dvec3 back = eye - key.vector("target");
    const glm::dvec3 up = key.has("up") ? key.vector("up") : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::cross(up, back);
    if (!(glm::dot(back, back) > 0.0)) key.refuse("looks at its own eye");
    if (!(glm::dot(right, right) > 1e-12 * glm::dot(up, up) * glm::dot(back, back)))
        key.refuse("looks along its 'up'");
    const glm::dvec3 z = glm::normalize(back);
    const glm::dvec3 x = glm::normalize(right);
    return {vec4(x, 0.0F), vec4(glm::cross(z, x), 0.0F), vec4(z, 0.0F), vec4(eye - origin, 1.0F)};
}

float verticalAngle(const KeyReader& key) {
    const auto radians = static_cast<float>(glm::radians(key.number("yfov")));
    if (!(radians > 0.0F && radians < kPi)) key.refuse("has a 'yfov' that is not between 0 and 180 degrees");
    return radians;
}

CameraKey readKey(const KeyReader& key, const Scene& scene, const Camera& start) {
    CameraKey result;
    if (!key.has("time")) key.refuse("has no 'time'");
    result.seconds = key.number("time");
    result.cut = key.flag("cut");
    result.camera = start;
    if (key.has("camera")) {
        if (key.has("eye") || key.has("target") || key.has("up"))
            key.refuse("has both 'camera' and 'eye', 'target' or 'up'");
        const std::string name = key.text("camera");
        const std::optional<std::size_t> named = findCamera(scene, name);
        if (!named) key.refuse(fmt::format("asks for camera '{}', which is not there", name));
        result.camera = scene.cameras[*named];
    } else {
        if (!key.has("eye") || !key.has("target"))
            key.refuse("has neither 'camera' nor both 'eye' and 'target'");
        result.camera.world_from_view = worldFromView(key, scene.origin);
    }
    if (result.camera.kind != start.kind) key.refuse("has another kind of camera than the path began with");
    if (key.has("yfov")) {
        if (start.kind != Camera::Kind::perspective) key.refuse("has a 'yfov', but no perspective camera");
        result.camera.y_fov = verticalAngle(key);
    }
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

std::vector<CameraKey>::const_iterator CameraKeys::firstBehind(double seconds) const {
    return std::upper_bound(keys_.begin(), keys_.end(), seconds,
                            [](double time, const CameraKey& key) { return time < key.seconds; });
}

Camera CameraKeys::at(double seconds) const {
    const auto behind = firstBehind(seconds);
    if (behind == keys_.begin()) return behind->camera;
    const CameraKey& before = *(behind - 1);
    if (behind == keys_.end() || behind->cut || before.seconds == seconds) return before.camera;
    return between(before.camera, behind->camera,
                   static_cast<float>((seconds - before.seconds) / (behind->seconds - before.seconds)));
}

bool CameraKeys::cutsBetween(double before, double seconds) const {
    return std::any_of(firstBehind(before), firstBehind(seconds),
                       [](const CameraKey& key) { return key.cut; });
}

CameraKeys readPathFile(const std::filesystem::path& path, const Scene& scene, const Camera& start) {
    const std::string name = path.string();
    const std::vector<std::byte> text = readFile(path, kMostBytes);
    const Json json = Json::parse(reinterpret_cast<const char*>(text.data()),
                                  reinterpret_cast<const char*>(text.data()) + text.size(), nullptr, false);
    if (json.is_discarded()) throw InputError(fmt::format("{}: is no JSON", name));
    if (!json.is_object() || !json.contains("keys") || !json["keys"].is_array() || json["keys"].empty())
        throw InputError(fmt::format("{}: has no list of 'keys' with at least one", name));
    constexpr std::array<std::string_view, 1> kKnown{"keys"};
    if (const auto stranger = strangerIn(json, kKnown))
        throw InputError(fmt::format("{}: {}", name, *stranger));
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
