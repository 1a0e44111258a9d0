#pragma once
// glTF files made by a test: JSON beside one binary buffer, written as .gltf + .bin, as .gltf with everything
// embedded, or as .glb.
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace licht::test {

using Json = nlohmann::json;

/// A folder of its own that goes with the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        static std::atomic<int> count{0};
        path_ = std::filesystem::temp_directory_path() /
                ("licht_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view content) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary)
            .write(content.data(), static_cast<std::streamsize>(content.size()));
        return file;
    }

private:
    std::filesystem::path path_;
};

inline std::string base64(std::string_view bytes) {
    static constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text +=
                i + k <= bytes.size() ? kDigits[group >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
        }
    }
    return text;
}

/// The words of a GLB in order, each in its place to be spoilt.
inline std::string glb(std::string_view json, std::string_view binary) {
    std::string json_chunk(json);
    json_chunk.resize((json_chunk.size() + 3) / 4 * 4, ' ');
    std::string binary_chunk(binary);
    binary_chunk.resize((binary_chunk.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    const auto word = [&file](std::size_t value) {
        for (unsigned shift = 0; shift < 32; shift += 8) {
            file += static_cast<char>(value >> shift & 255U);
        }
    };
    word(2);
    word(12 + 8 + json_chunk.size() + (binary_chunk.empty() ? 0 : 8 + binary_chunk.size()));
    word(json_chunk.size());
    file += "JSON" + json_chunk;
    if (!binary_chunk.empty()) {
        word(binary_chunk.size());
        file += std::string("BIN\0", 4) + binary_chunk;
    }
    return file;
}

inline constexpr int kByte = 5120;
inline constexpr int kUnsignedByte = 5121;
inline constexpr int kShort = 5122;
inline constexpr int kUnsignedShort = 5123;
inline constexpr int kUnsignedInt = 5125;
inline constexpr int kFloat = 5126;

template <typename T>
std::string bytesOf(std::span<const T> values) {
    std::string bytes(values.size_bytes(), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

class GltfFile {
public:
    Json json{{"asset", {{"version", "2.0"}}}};
    std::string binary;

    /// Each returns the index of what it adds.
    int view(std::string_view bytes, int stride = 0) {
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        Json v{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        if (stride > 0) {
            v["byteStride"] = stride;
        }
        binary += bytes;
        return add("bufferViews", v);
    }
    int add(const char* list, Json element) {
        json[list].push_back(std::move(element));
        return static_cast<int>(json[list].size()) - 1;
    }
    template <typename T>
    int accessor(const std::vector<T>& values, int component_type, const std::string& type, std::size_t count,
                 bool normalized = false) {
        Json a{{"bufferView", view(bytesOf(std::span<const T>(values)))},
               {"componentType", component_type},
               {"count", count},
               {"type", type}};
        if (normalized) {
            a["normalized"] = true;
        }
        return add("accessors", a);
    }
    int vec2s(const std::vector<float>& values) {
        return accessor(values, kFloat, "VEC2", values.size() / 2);
    }
    int vec3s(const std::vector<float>& values) {
        return accessor(values, kFloat, "VEC3", values.size() / 3);
    }
    int vec4s(const std::vector<float>& values) {
        return accessor(values, kFloat, "VEC4", values.size() / 4);
    }
    int indices(const std::vector<std::uint16_t>& values) {
        return accessor(values, kUnsignedShort, "SCALAR", values.size());
    }

    /// A mesh of one primitive.
    int mesh(Json primitive) {
        return add("meshes", {{"name", "M"}, {"primitives", Json::array({std::move(primitive)})}});
    }
    /// A node that is a root of scene 0.
    int root(Json node) {
        const int index = add("nodes", std::move(node));
        if (!json.contains("scenes")) {
            json["scenes"] = Json::array({{{"nodes", Json::array()}}});
        }
        json["scenes"][0]["nodes"].push_back(index);
        return index;
    }
    /// One right-angled triangle in the xy plane with legs of length one, as mesh 0 on one root node.
    static GltfFile triangle() {
        GltfFile file;
        const int positions = file.vec3s({0, 0, 0, 1, 0, 0, 0, 1, 0});
        file.mesh({{"attributes", {{"POSITION", positions}}}});
        file.root({{"mesh", 0}, {"name", "N"}});
        return file;
    }
    Json& primitive() { return json["meshes"][0]["primitives"][0]; }

    std::filesystem::path writeExternal(const TemporaryFolder& folder) const {
        folder.write("scene.bin", binary);
        return folder.write("scene.gltf", withBuffer("scene.bin").dump());
    }
    std::filesystem::path writeEmbedded(const TemporaryFolder& folder) const {
        return folder.write("embedded.gltf",
                            withBuffer("data:application/octet-stream;base64," + base64(binary)).dump());
    }
    std::filesystem::path writeGlb(const TemporaryFolder& folder) const {
        return folder.write("scene.glb", glb(withBuffer("").dump(), binary));
    }

    /// The JSON with its buffer, unless the test wrote its own.
    Json withBuffer(const std::string& uri) const {
        Json whole = json;
        if (!whole.contains("buffers") && !binary.empty()) {
            Json buffer{{"byteLength", binary.size()}};
            if (!uri.empty()) {
                buffer["uri"] = uri;
            }
            whole["buffers"] = Json::array({buffer});
        }
        return whole;
    }
};

}  // namespace licht::test
