#pragma once
// Where the bytes that a glTF names come from: data URIs and files of the asset's own folder, nothing else.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "licht/core/one_line.h"

namespace licht::gltf {

/// The folder of a scene file. Nothing outside of it is ever opened.
class AssetFolder {
public:
    /// Throws InputError when the folder is not there.
    explicit AssetFolder(const std::filesystem::path& scene_file);

    /// The bytes behind a URI. Throws InputError "<file>: <object>: uri '<uri>': <reason>": a scheme, an
    /// absolute path, a backslash, a NUL, a way out of the folder (by `..` or by a symbolic link), no regular
    /// file, bad base64, or more than kMaxAssetBytes in total.
    std::vector<std::byte> read(std::string_view uri, const std::string& object);

    /// What all files and data URIs of one asset may weigh together.
    static constexpr std::uint64_t kMaxAssetBytes = std::uint64_t{4} << 30U;

    /// The file that a URI names; nullopt where read() would find none. Reads nothing.
    [[nodiscard]] std::optional<std::filesystem::path> find(std::string_view uri) const;

private:
    std::vector<std::byte> readData(std::string_view uri) const;
    [[nodiscard]] std::filesystem::path resolve(std::string_view uri) const;

    std::string file_;
    std::filesystem::path folder_;
    std::uint64_t bytes_left_ = kMaxAssetBytes;
};

/// RFC 3986 percent-decoding. Throws std::invalid_argument on a '%' without two hexadecimal digits.
std::string percentDecode(std::string_view text);

/// licht::oneLine(), short enough for a message.
inline std::string oneLine(std::string_view text, std::size_t limit = 200) {
    return licht::oneLine(text, limit);
}

}  // namespace licht::gltf
