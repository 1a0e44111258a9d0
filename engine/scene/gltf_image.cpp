#include "licht/scene/gltf_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>

#include "licht/core/error.h"
#include "licht/core/memory.h"

namespace licht::gltf {
namespace {

/// Checks of magenta, which no material is by intent.
Texture standIn(std::string name) {
    constexpr std::uint32_t kSide = 8;
    Texture texture{std::move(name), kSide, kSide, 8, {}};
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
        const std::uint8_t bright = (i + i / kSide) % 2 == 0 ? 255 : 0;
        texture.bytes.insert(texture.bytes.end(), {bright, 0, bright, 255});
    }
    return texture;
}

std::string shownName(const ImageSource& source, const std::string& name) {
    constexpr std::size_t kShownUri = 80;
    if (!source.name.empty()) return source.name;
    return source.uri.empty() || source.uri.starts_with("data:") ? name : oneLine(source.uri, kShownUri);
}

}  // namespace

std::uint32_t TextureLoader::load(int image, const std::string& object) {
    const ImageSource& source = at(asset_, asset_.images, image, object, "image");
    const std::pair key(source.uri, source.uri.empty() ? source.buffer_view : -1);
    if (const auto it = by_source_.find(key); it != by_source_.end()) return it->second;
    const std::string name = objectName("image", static_cast<std::size_t>(image), source.name);
    Pending pending{shownName(source, name), fmt::format("{}: {}", asset_.file, name), {}, {}, {}, {}};
    try {
        if (source.uri.empty()) {
            pending.encoded = viewBytes(asset_, source.buffer_view, name);
        } else {
            pending.file = asset_.folder.read(source.uri, name);
            pending.encoded = pending.file;
        }
        pending.shape = shapeOfImage(pending.encoded, pending.object);
    } catch (const InputError& error) {
        if (asset_.strict) throw;
        pending.fault = error.what();
    }
    const auto index = sameContent(pending).value_or(static_cast<std::uint32_t>(pending_.size()));
    by_source_.emplace(key, index);
    if (index == pending_.size()) pending_.push_back(std::move(pending));
    return index;
}

std::optional<std::uint32_t> TextureLoader::sameContent(const Pending& image) {
    if (!image.fault.empty()) return std::nullopt;
    const std::string_view bytes(reinterpret_cast<const char*>(image.encoded.data()), image.encoded.size());
    std::vector<std::uint32_t>& alike = by_hash_[std::hash<std::string_view>()(bytes)];
    for (const std::uint32_t index : alike)
        if (std::ranges::equal(pending_[index].encoded, image.encoded)) return index;
    alike.push_back(static_cast<std::uint32_t>(pending_.size()));
    return std::nullopt;
}

std::vector<bool> TextureLoader::decodeAll() {
    double bytes = 0.0;
    for (const Pending& image : pending_)
        if (image.fault.empty()) bytes += static_cast<double>(image.shape.bytes());
    requireMemory(
        bytes, fmt::format("{}: the {} images of its textures take, decoded,", asset_.file, pending_.size()));
    std::vector<bool> broken(pending_.size());
    for (std::size_t i = 0; i < pending_.size(); ++i) {
        Pending& image = pending_[i];
        Texture texture = standIn(image.name);
        if (image.fault.empty()) {
            try {
                EncodedImage decoded = decodeImage(image.encoded, image.object);
                texture.width = static_cast<std::uint32_t>(decoded.width);
                texture.height = static_cast<std::uint32_t>(decoded.height);
                texture.bits = static_cast<std::uint32_t>(decoded.bits);
                texture.bytes = std::move(decoded.bytes);
            } catch (const InputError& error) {
                if (asset_.strict) throw;
                image.fault = error.what();
            }
        }
        image.file = {};
        broken[i] = !image.fault.empty();
        if (broken[i])
            asset_.warn(fmt::format("{} (colours that it gives are magenta checks, all else goes without it)",
                                    image.fault));
        scene_.textures.push_back(std::move(texture));
    }
    return broken;
}

}  // namespace licht::gltf
