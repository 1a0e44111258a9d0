#include <fmt/format.h>

#include "licht/core/error.h"
#include "licht/image/files.h"
#include "licht/scene/gltf_material.h"

namespace licht::gltf {

std::uint32_t TextureLoader::load(int image, const std::string& object) {
    if (const auto it = loaded_.find(image); it != loaded_.end()) {
        return it->second;
    }
    const ImageSource& source = at(asset_, asset_.images, image, object, "image");
    const std::string name = objectName("image", static_cast<std::size_t>(image), source.name);
    std::vector<std::byte> file;
    std::span<const std::byte> encoded;
    if (!source.uri.empty()) {
        file = asset_.folder.read(source.uri, name);
        encoded = file;
    } else {
        encoded = viewBytes(asset_, source.buffer_view, name);
    }
    EncodedImage decoded = decodeImage(encoded, fmt::format("{}: {}", asset_.file, name));

    Texture texture;
    constexpr std::size_t kShownUri = 80;
    texture.name = !source.name.empty()                                    ? source.name
                   : source.uri.empty() || source.uri.starts_with("data:") ? name
                                                                           : oneLine(source.uri, kShownUri);
    texture.width = static_cast<std::uint32_t>(decoded.width);
    texture.height = static_cast<std::uint32_t>(decoded.height);
    texture.bits = static_cast<std::uint32_t>(decoded.bits);
    texture.bytes = std::move(decoded.bytes);
    const auto index = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
    loaded_.emplace(image, index);
    return index;
}

}  // namespace licht::gltf
