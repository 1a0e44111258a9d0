#include "licht/scene/gltf_container.h"

#include <fmt/format.h>

#include <cstdint>

#include "licht/core/error.h"

namespace licht::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67U;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534AU;
constexpr std::uint32_t kBinaryChunk = 0x004E4942U;
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8U * static_cast<std::uint32_t>(i));
    }
    return value;
}

std::string_view text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Container splitBinary(std::span<const std::byte> bytes, const std::string& file) {
    if (bytes.size() < kHeaderBytes) {
        throw InputError(fmt::format("{}: truncated: {} bytes are no whole GLB header", file, bytes.size()));
    }
    if (const std::uint32_t version = word(bytes, 4); version != 2) {
        throw InputError(fmt::format("{}: GLB version {} is not supported", file, version));
    }
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size()) {
        throw InputError(
            fmt::format("{}: truncated: its header says {} bytes, it has {}", file, length, bytes.size()));
    }
    Container container;
    bool first = true;
    for (std::size_t offset = kHeaderBytes; offset < length; first = false) {
        if (length - offset < kChunkHeaderBytes) {
            throw InputError(fmt::format("{}: a GLB chunk header at byte {} is cut", file, offset));
        }
        const std::size_t size = word(bytes, offset);
        const std::uint32_t type = word(bytes, offset + 4);
        offset += kChunkHeaderBytes;
        if (size > length - offset) {
            throw InputError(
                fmt::format("{}: a GLB chunk of {} bytes does not fit into the file", file, size));
        }
        if (first != (type == kJsonChunk)) {
            throw InputError(fmt::format("{}: the first GLB chunk, and only that, must be JSON", file));
        }
        const std::span<const std::byte> chunk = bytes.subspan(offset, size);
        if (type == kJsonChunk) {
            container.json = text(chunk);
        } else if (type == kBinaryChunk && !container.binary) {
            container.binary = chunk;
        }
        offset += size;
    }
    if (container.json.empty()) {
        throw InputError(fmt::format("{}: a GLB without JSON", file));
    }
    return container;
}

}  // namespace

Container splitContainer(std::span<const std::byte> bytes, const std::string& file) {
    if (bytes.empty()) {
        throw InputError(fmt::format("{}: the file is empty", file));
    }
    if (bytes.size() >= 4 && word(bytes, 0) == kMagic) {
        return splitBinary(bytes, file);
    }
    return Container{text(bytes), std::nullopt};
}

}  // namespace licht::gltf
