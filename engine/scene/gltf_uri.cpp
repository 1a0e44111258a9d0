#include "licht/scene/gltf_uri.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "licht/core/error.h"
#include "licht/core/file.h"

namespace licht::gltf {
namespace {

int hexValue(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

bool isAlphanumeric(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool isBase64(std::string_view text) {
    const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    text.remove_suffix(padding);
    return (padding == 0 || (text.size() + padding) % 4 == 0) && text.size() % 4 != 1 &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return isAlphanumeric(c) || c == '+' || c == '/'; });
}

/// RFC 3986: a letter, then letters, digits, '+', '-', '.', up to the first ':'.
bool hasScheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    const std::size_t slash = uri.find('/');
    return colon != std::string_view::npos && colon > 0 &&
           (slash == std::string_view::npos || colon < slash) &&
           std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                       [](char c) { return isAlphanumeric(c) || c == '+' || c == '-' || c == '.'; });
}

bool isInside(const std::filesystem::path& path, const std::filesystem::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

std::string percentDecode(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hexValue(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hexValue(text[i + 2]) : -1;
        if (high < 0 || low < 0) {
            throw std::invalid_argument("'%' is not followed by two hexadecimal digits");
        }
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return decoded;
}

AssetFolder::AssetFolder(const std::filesystem::path& scene_file) : file_(scene_file.string()) {
    std::error_code error;
    const std::filesystem::path parent = scene_file.parent_path();
    folder_ = std::filesystem::canonical(parent.empty() ? "." : parent, error);
    if (error) {
        throw InputError(fmt::format("{}: its folder cannot be opened: {}", file_, error.message()));
    }
}

std::vector<std::byte> AssetFolder::read(std::string_view uri, const std::string& object) {
    try {
        std::vector<std::byte> bytes =
            uri.starts_with("data:") ? readData(uri) : readFile(resolve(uri), bytes_left_);
        if (bytes.size() > bytes_left_) {
            throw InputError("the asset is larger than 4 GiB in total");
        }
        bytes_left_ -= bytes.size();
        return bytes;
    } catch (const std::exception& e) {
        constexpr std::size_t kShownUri = 80;
        throw InputError(
            fmt::format("{}: {}: uri '{}': {}", file_, object, oneLine(uri, kShownUri), oneLine(e.what())));
    }
}

std::vector<std::byte> AssetFolder::readData(std::string_view uri) const {
    constexpr std::string_view kMarker = ";base64,";
    const std::size_t marker = uri.find(kMarker);
    if (marker == std::string_view::npos || uri.find(',') < marker) {
        throw InputError("a data URI that is not base64");
    }
    const std::string_view payload = uri.substr(marker + kMarker.size());
    if (!isBase64(payload)) {
        throw InputError("the base64 text is damaged");
    }
    // The decoder knows few media types; here the type does not matter.
    std::string type;
    std::vector<unsigned char> decoded;
    if (!payload.empty() &&
        !tinygltf::DecodeDataURI(
            &decoded, type, std::string("data:application/octet-stream;base64,").append(payload), 0, false)) {
        throw InputError("the base64 text is damaged");
    }
    std::vector<std::byte> bytes(decoded.size());
    std::transform(decoded.begin(), decoded.end(), bytes.begin(),
                   [](unsigned char c) { return std::byte{c}; });
    return bytes;
}

std::optional<std::filesystem::path> AssetFolder::find(std::string_view uri) const {
    if (uri.starts_with("data:")) return std::nullopt;
    try {
        return resolve(uri);
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

std::filesystem::path AssetFolder::resolve(std::string_view uri) const {
    if (uri.empty()) {
        throw InputError("it is empty");
    }
    if (hasScheme(uri)) {
        throw InputError("only files of the asset's own folder are read, no scheme is");
    }
    const std::string decoded = percentDecode(uri);
    if (decoded.find('\0') != std::string::npos || decoded.find('\\') != std::string::npos) {
        throw InputError("a path must not contain NUL or a backslash");
    }
    const std::filesystem::path relative(decoded);
    if (relative.is_absolute()) {
        throw InputError("an absolute path is not read");
    }
    // By words first, so that a path that leaves the folder is refused even where nothing exists, then with
    // symbolic links resolved.
    const std::filesystem::path normal = relative.lexically_normal();
    const std::filesystem::path real = std::filesystem::weakly_canonical(folder_ / normal);
    if ((!normal.empty() && *normal.begin() == "..") || !isInside(real, folder_)) {
        throw InputError("it leads out of the asset's folder");
    }
    return real;
}

}  // namespace licht::gltf
