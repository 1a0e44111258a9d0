#include "licht/scene/gltf_asset.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "licht/core/error.h"
#include "licht/core/file.h"
#include "licht/scene/gltf_container.h"
#include "licht/scene/gltf_extensions.h"
#include "licht/scene/gltf_indices.h"
#include "licht/scene/gltf_meshopt.h"
#include "licht/scene/gltf_sizes.h"

namespace licht::gltf {
namespace {

using Json = nlohmann::json;

/// JSON nested deeper than this would end in recursion somewhere; glTF itself needs about ten levels.
constexpr int kMaxJsonDepth = 200;

/// How deep brackets nest outside of strings. (The parser could tell by a callback, but then takes quadratic
/// time for long arrays.)
int jsonDepth(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            i += c == '\\' ? 1 : 0;
            in_string = c != '"';
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return deepest;
}

Json parseJson(std::string_view text, const std::string& file) {
    if (jsonDepth(text) > kMaxJsonDepth) {
        throw InputError(fmt::format("{}: JSON nested deeper than {} levels", file, kMaxJsonDepth));
    }
    try {
        Json document = Json::parse(text.begin(), text.end());
        if (!document.is_object()) {
            throw InputError(fmt::format("{}: no glTF: its JSON is not an object", file));
        }
        return document;
    } catch (const Json::exception& e) {
        throw InputError(fmt::format("{}: no glTF: {}", file, oneLine(e.what())));
    }
}

std::string stringOf(const Json& object, const char* key) {
    const auto it = object.find(key);
    return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}

const Json& arrayOf(const Json& document, const char* key) {
    static const Json kEmpty = Json::array();
    const auto it = document.find(key);
    return it != document.end() && it->is_array() ? *it : kEmpty;
}

void checkVersion(const Json& document, const std::string& file) {
    const auto asset = document.find("asset");
    const std::string version = asset != document.end() ? stringOf(*asset, "version") : std::string();
    if (version.empty()) {
        throw InputError(fmt::format("{}: no glTF: asset.version is missing", file));
    }
    const std::string least = stringOf(*asset, "minVersion");
    if (!version.starts_with("2.") || (!least.empty() && least != "2.0")) {
        throw InputError(fmt::format("{}: glTF version {} is not supported, 2.0 is", file,
                                     oneLine(least.empty() ? version : least)));
    }
}

void checkExtensions(const Json& document, Asset& asset) {
    for (const Json& name : arrayOf(document, "extensionsRequired")) {
        if (name.is_string() && !knowsGltfExtension(name.get_ref<const std::string&>())) {
            throw InputError(fmt::format("{}: required extension '{}' is not supported", asset.file,
                                         oneLine(name.get_ref<const std::string&>())));
        }
    }
    for (const Json& name : arrayOf(document, "extensionsUsed")) {
        if (name.is_string() && !knowsGltfExtension(name.get_ref<const std::string&>())) {
            asset.warn(fmt::format("extension '{}' is not supported and ignored",
                                   oneLine(name.get_ref<const std::string&>())));
        }
    }
}

void readBuffers(const Json& document, const Container& container, Asset& asset) {
    for (const Json& buffer : arrayOf(document, "buffers")) {
        const std::size_t index = asset.buffers.size();
        const std::string object =
            objectName("buffer", index, buffer.is_object() ? stringOf(buffer, "name") : "");
        const auto length = buffer.find("byteLength");
        if (!buffer.is_object() || length == buffer.end() || !length->is_number_unsigned()) {
            asset.fail(object, "byteLength is missing or no positive integer");
        }
        const auto size = length->get<std::uint64_t>();
        std::vector<std::byte> bytes;
        if (const std::string uri = stringOf(buffer, "uri"); !uri.empty()) {
            bytes = asset.folder.read(uri, object);
            asset.buffer_uris.push_back(uri);
        } else if (index == 0 && container.binary) {
            bytes.assign(container.binary->begin(), container.binary->end());
        } else if (isMeshoptFallback(buffer)) {
            // A placeholder: whatever view of it is not compressed is told by viewBytes that nothing is
            // there.
            asset.buffers.emplace_back();
            continue;
        } else {
            asset.fail(object, "it has neither a uri nor a binary chunk");
        }
        if (bytes.size() < size) {
            asset.fail(object,
                       fmt::format("byteLength is {}, but only {} bytes are there", size, bytes.size()));
        }
        bytes.resize(size);
        asset.buffers.push_back(std::move(bytes));
    }
}

void readImages(const Json& document, Asset& asset) {
    for (const Json& image : arrayOf(document, "images")) {
        ImageSource source;
        if (image.is_object()) {
            source.name = stringOf(image, "name");
            source.uri = stringOf(image, "uri");
            const auto view = image.find("bufferView");
            if (view != image.end() && view->is_number_unsigned() &&
                view->get<std::uint64_t>() <= INT32_MAX) {
                source.buffer_view = view->get<int>();
            }
        }
        asset.images.push_back(std::move(source));
    }
}

template <typename... Lists>
void cleanNames(Lists&... lists) {
    const auto clean = [](auto& list) {
        for (auto& element : list) element.name = licht::oneLine(element.name);
    };
    (clean(lists), ...);
}

/// No file is there. tinygltf takes complete sets only and asks for sizes of files since 2.9.
template <typename Callbacks>
Callbacks noFiles() {
    Callbacks files{};
    files.FileExists = [](const std::string&, void*) { return false; };
    files.ExpandFilePath = [](const std::string& path, void*) { return path; };
    files.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&, void*) {
        return false;
    };
    files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
        return false;
    };
    if constexpr (requires { files.GetFileSizeInBytes; }) {
        files.GetFileSizeInBytes = [](std::size_t*, std::string*, const std::string&, void*) {
            return false;
        };
    }
    return files;
}

void parseModel(Json& document, Asset& asset) {
    document.erase("buffers");
    document.erase("images");
    const std::string text = document.dump();
    if (text.size() > UINT32_MAX) {
        throw InputError(fmt::format("{}: its JSON is larger than 4 GiB", asset.file));
    }
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(noFiles<tinygltf::FsCallbacks>());
    std::string errors;
    std::string warnings;
    bool parsed = false;
    try {
        parsed = parser.LoadASCIIFromString(&asset.model, &errors, &warnings, text.data(),
                                            static_cast<unsigned int>(text.size()), "");
    } catch (const std::exception& e) {
        errors = e.what();
    }
    if (!parsed) {
        throw InputError(fmt::format("{}: no valid glTF: {}", asset.file, oneLine(errors)));
    }
    tinygltf::Model& m = asset.model;
    cleanNames(m.accessors, m.animations, m.bufferViews, m.cameras, m.lights, m.materials, m.meshes, m.nodes,
               m.scenes, m.skins, m.textures);
    std::istringstream lines(errors);
    for (std::string line; std::getline(lines, line);) {
        // tinygltf asks for a property that the specification leaves optional.
        if (!line.empty() && line.find("inverseBindMatrices") == std::string::npos) {
            asset.warn(oneLine(line));
        }
    }
}

}  // namespace

void Asset::note(SceneNote::Kind kind, const std::string& text) {
    if (noted.insert(text).second) {
        notes.push_back({kind, text});
    }
}

void Asset::fail(std::string_view object, std::string_view reason) const {
    throw InputError(fmt::format("{}: {}: {}", file, object, reason));
}

std::string objectName(std::string_view kind, std::size_t index, std::string_view name) {
    constexpr std::size_t kShownName = 80;
    return name.empty() ? fmt::format("{} {}", kind, index)
                        : fmt::format("{} {} '{}'", kind, index, oneLine(name, kShownName));
}

std::span<const std::byte> viewBytes(const Asset& asset, int view, std::string_view object) {
    const tinygltf::BufferView& v = at(asset, asset.model.bufferViews, view, object, "buffer view");
    const std::vector<std::byte>& buffer = at(asset, asset.buffers, v.buffer, object, "buffer");
    if (v.byteOffset > buffer.size() || v.byteLength > buffer.size() - v.byteOffset) {
        asset.fail(object, fmt::format("buffer view {} reaches beyond the {} bytes of buffer {}", view,
                                       buffer.size(), v.buffer));
    }
    return std::span(buffer).subspan(v.byteOffset, v.byteLength);
}

Asset readAsset(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    Asset asset{path.string(), AssetFolder(path), {}, {}, {}, {}, false, {}, {}};
    const Container container = splitContainer(bytes, asset.file);
    Json document = parseJson(container.json, asset.file);
    checkVersion(document, asset.file);
    checkExtensions(document, asset);
    readBuffers(document, container, asset);
    requireSizes(document, asset);
    requireIndices(document, asset);
    decodeMeshopt(document, asset);
    readImages(document, asset);
    parseModel(document, asset);
    return asset;
}

}  // namespace licht::gltf
