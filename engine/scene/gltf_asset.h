#pragma once
// A glTF file as it stands in memory: its structure (parsed by tinygltf) and its buffers, before anything is
// made of it.
#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "licht/scene/gltf_uri.h"
#include "licht/scene/scene.h"

namespace licht::gltf {

/// The sets of texture coordinates that are read; the specification asks for two.
inline constexpr int kMaxUvSets = 8;

/// An image before it is decoded: a URI or a buffer view.
struct ImageSource {
    std::string name;
    std::string uri;
    int buffer_view = -1;
};

/// tinygltf sees the JSON without its buffers and images: it never opens a file. They are read here, through
/// AssetFolder.
struct Asset {
    std::string file;  ///< for messages
    AssetFolder folder;
    tinygltf::Model model;
    std::vector<std::vector<std::byte>> buffers;
    std::vector<std::string> buffer_uris;
    std::vector<ImageSource> images;
    bool strict = false;  ///< what could be read without is an error
    std::vector<SceneNote> notes;
    std::set<std::string> noted;

    /// Adds a note once.
    void note(SceneNote::Kind kind, const std::string& text);
    void warn(const std::string& text) { note(SceneNote::Kind::warning, text); }
    void skip(const std::string& text) { note(SceneNote::Kind::skipped, text); }

    /// Throws InputError "<file>: <object>: <reason>".
    [[noreturn]] void fail(std::string_view object, std::string_view reason) const;
};

/// Reads and checks the container, the JSON and the buffers. Throws InputError.
Asset readAsset(const std::filesystem::path& path);

/// "mesh 3 'Wheel'", or "mesh 3" where it has no name.
std::string objectName(std::string_view kind, std::size_t index, std::string_view name);

/// The bytes of a buffer view, checked against its buffer. Throws InputError naming `object`.
std::span<const std::byte> viewBytes(const Asset& asset, int view, std::string_view object);

/// The element of that index, or an InputError "<object>: <what> <index> is not there".
template <typename T>
const T& at(const Asset& asset, const std::vector<T>& values, int index, std::string_view object,
            std::string_view what) {
    if (index < 0 || static_cast<std::size_t>(index) >= values.size()) {
        asset.fail(object, std::string(what) + " " + std::to_string(index) + " is not there");
    }
    return values[static_cast<std::size_t>(index)];
}

}  // namespace licht::gltf
