#include "licht/scene/gltf_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "licht/core/one_line.h"

namespace licht::gltf {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 4> kSizes{"count", "byteOffset", "byteLength", "byteStride"};

void require(const Json& object, std::uint64_t most, const std::string& path, const std::string& name,
             const Asset& asset) {
    for (const auto& [key, value] : object.items()) {
        if (std::find(kSizes.begin(), kSizes.end(), key) == kSizes.end()) continue;
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
            constexpr std::size_t kShown = 40;
            asset.fail(name, fmt::format("{}{} is {}, no whole number from 0 to {}", path, key,
                                         oneLine(value.dump(), kShown), most));
        }
    }
}

/// Within sparse parts, the oldest parser that is built with keeps sizes as int.
void requireOfSparse(const Json& sparse, const std::string& name, const Asset& asset) {
    require(sparse, INT32_MAX, "sparse.", name, asset);
    for (const char* part : {"indices", "values"}) {
        if (const auto it = sparse.find(part); it != sparse.end() && it->is_object())
            require(*it, INT32_MAX, fmt::format("sparse.{}.", part), name, asset);
    }
}

}  // namespace

void requireSizes(const Json& document, const Asset& asset) {
    for (const auto& [list, kind] : {std::pair{"accessors", "accessor"}, {"bufferViews", "buffer view"}}) {
        const auto elements = document.find(list);
        if (elements == document.end() || !elements->is_array()) continue;
        for (std::size_t i = 0; i < elements->size(); ++i) {
            const Json& element = (*elements)[i];
            if (!element.is_object()) continue;
            const auto named = element.find("name");
            const std::string name = objectName(
                kind, i,
                named != element.end() && named->is_string() ? named->get_ref<const std::string&>() : "");
            require(element, UINT64_MAX, "", name, asset);
            if (const auto sparse = element.find("sparse"); sparse != element.end() && sparse->is_object())
                requireOfSparse(*sparse, name, asset);
        }
    }
}

}  // namespace licht::gltf
