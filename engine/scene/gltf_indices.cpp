#include "licht/scene/gltf_indices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "licht/core/one_line.h"
#include "licht/scene/gltf_extensions.h"

namespace licht::gltf {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 18> kSingle{
    "buffer",   "bufferView", "camera",   "children", "index", "indices", "inverseBindMatrices",
    "joints",   "light",      "material", "mesh",     "nodes", "sampler", "scene",
    "skeleton", "skin",       "source",   "texCoord"};
/// Objects of them, of any names.
constexpr std::array<std::string_view, 2> kMany{"attributes", "targets"};

template <typename List>
bool has(const List& list, std::string_view name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

bool isIndex(const Json& number) {
    if (number.is_number_unsigned()) return number.get<std::uint64_t>() <= INT32_MAX;
    return number.is_number_integer() && number.get<std::int64_t>() >= INT32_MIN;
}

/// `name`: of the property that the value belongs to. `path`: to it, for the message.
void require(const Json& value, std::string_view name, std::string& path, const Asset& asset) {
    const std::size_t length = path.size();
    if (value.is_number() && (has(kSingle, name) || has(kMany, name)) && !isIndex(value)) {
        constexpr std::size_t kShown = 40;
        constexpr std::size_t kShownPath = 200;
        asset.fail(oneLine(path, kShownPath), fmt::format("{} is no index", oneLine(value.dump(), kShown)));
    }
    if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) {
            path += fmt::format("[{}]", i);
            require(value[i], name, path, asset);
            path.resize(length);
        }
    }
    if (value.is_object()) {
        for (const auto& [key, part] : value.items()) {
            if (key == "extras" || (name == "extensions" && !knowsGltfExtension(key))) continue;
            path += (path.empty() ? "" : ".") + key;
            require(part, has(kMany, name) ? name : key, path, asset);
            path.resize(length);
        }
    }
}

}  // namespace

void requireIndices(const Json& document, const Asset& asset) {
    std::string path;
    require(document, "", path, asset);
}

}  // namespace licht::gltf
