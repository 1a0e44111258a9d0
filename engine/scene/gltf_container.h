#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace licht::gltf {

/// The two chunks of a binary glTF, or a .gltf as one.
struct Container {
    std::string_view json;
    std::optional<std::span<const std::byte>> binary;
};

/// Splits a file after checking every length against its real size. Throws InputError naming `file`.
Container splitContainer(std::span<const std::byte> bytes, const std::string& file);

}  // namespace licht::gltf
