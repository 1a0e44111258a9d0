#include "licht/scene/gltf_meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <nlohmann/json.hpp>

namespace licht::gltf {
namespace {

using Json = nlohmann::json;

/// The tightest code there is, two bits for sixteen bytes of an attribute: no honest view expands further.
constexpr std::uint64_t kMaxExpansion = 64;

/// The extension's object in a buffer or buffer view, or null.
const Json* extensionOf(const Json& object) {
    if (!object.is_object()) {
        return nullptr;
    }
    const auto extensions = object.find("extensions");
    if (extensions == object.end() || !extensions->is_object()) {
        return nullptr;
    }
    const auto extension = extensions->find("EXT_meshopt_compression");
    return extension != extensions->end() && extension->is_object() ? &*extension : nullptr;
}

/// One compressed view.
class View {
public:
    View(const Asset& asset, const Json& extension, std::string object)
        : asset_(asset),
          extension_(extension),
          object_(std::move(object)),
          mode_(text("mode", "")),
          filter_(text("filter", "NONE")),
          count_(integer("count")),
          stride_(integer("byteStride")) {}

    /// Bytes when decoded. Every factor is small enough for their product once this returns.
    [[nodiscard]] std::uint64_t decodedBytes() const {
        const bool attributes = mode_ == "ATTRIBUTES";
        if (!attributes && mode_ != "TRIANGLES" && mode_ != "INDICES") {
            fail(fmt::format("its mode '{}' is unknown", oneLine(mode_)));
        }
        if (attributes ? stride_ == 0 || stride_ > 256 || stride_ % 4 != 0 : stride_ != 2 && stride_ != 4) {
            fail(fmt::format("mode {} does not allow a byteStride of {}", mode_, stride_));
        }
        if (mode_ == "TRIANGLES" && count_ % 3 != 0) {
            fail(fmt::format("{} indices are no whole triangles", count_));
        }
        checkFilter(attributes);
        if (count_ > kMaxExpansion * encoded().size() / stride_) {
            fail(fmt::format("{} elements of {} bytes cannot come out of {} compressed bytes", count_,
                             stride_, encoded().size()));
        }
        return count_ * stride_;
    }

    [[nodiscard]] std::vector<std::byte> decode() const {
        std::vector<std::byte> bytes(count_ * stride_);
        const auto* source = reinterpret_cast<const unsigned char*>(encoded().data());
        const std::size_t size = encoded().size();
        int fault = 0;
        if (mode_ == "ATTRIBUTES") {
            fault = meshopt_decodeVertexBuffer(bytes.data(), count_, stride_, source, size);
        } else if (mode_ == "TRIANGLES") {
            fault = meshopt_decodeIndexBuffer(bytes.data(), count_, stride_, source, size);
        } else {
            fault = meshopt_decodeIndexSequence(bytes.data(), count_, stride_, source, size);
        }
        if (fault != 0) {
            fail(fmt::format("its {} bytes of mode {} are damaged (decoder error {})", size, mode_, fault));
        }
        if (filter_ == "OCTAHEDRAL") {
            meshopt_decodeFilterOct(bytes.data(), count_, stride_);
        } else if (filter_ == "QUATERNION") {
            meshopt_decodeFilterQuat(bytes.data(), count_, stride_);
        } else if (filter_ == "EXPONENTIAL") {
            meshopt_decodeFilterExp(bytes.data(), count_, stride_);
        }
        return bytes;
    }

    [[noreturn]] void fail(const std::string& reason) const {
        asset_.fail(object_, "EXT_meshopt_compression: " + reason);
    }

private:
    void checkFilter(bool attributes) const {
        const bool octahedral = filter_ == "OCTAHEDRAL";
        const bool quaternion = filter_ == "QUATERNION";
        if (!octahedral && !quaternion && filter_ != "EXPONENTIAL" && filter_ != "NONE") {
            fail(fmt::format("its filter '{}' is unknown", oneLine(filter_)));
        }
        const bool fits = (!octahedral || stride_ == 4 || stride_ == 8) && (!quaternion || stride_ == 8);
        if (filter_ != "NONE" && (!attributes || !fits)) {
            fail(fmt::format("filter {} does not go with mode {} and a byteStride of {}", filter_, mode_,
                             stride_));
        }
    }

    [[nodiscard]] std::span<const std::byte> encoded() const {
        const std::uint64_t index = integer("buffer");
        if (index >= asset_.buffers.size()) {
            fail(fmt::format("buffer {} is not there", index));
        }
        const std::vector<std::byte>& buffer = asset_.buffers[index];
        const std::uint64_t offset = extension_.contains("byteOffset") ? integer("byteOffset") : 0;
        const std::uint64_t length = integer("byteLength");
        if (offset > buffer.size() || length > buffer.size() - offset) {
            fail(fmt::format("{} bytes from byte {} on reach beyond the {} bytes of buffer {}", length,
                             offset, buffer.size(), index));
        }
        return std::span(buffer).subspan(offset, length);
    }

    [[nodiscard]] std::uint64_t integer(const char* key) const {
        const auto it = extension_.find(key);
        if (it == extension_.end() || !it->is_number_unsigned()) {
            fail(fmt::format("{} is missing or no natural number", key));
        }
        return it->get<std::uint64_t>();
    }

    [[nodiscard]] std::string text(const char* key, const char* fallback) const {
        const auto it = extension_.find(key);
        return it != extension_.end() && it->is_string() ? it->get<std::string>() : fallback;
    }

    const Asset& asset_;
    const Json& extension_;
    std::string object_;
    std::string mode_;
    std::string filter_;
    std::uint64_t count_;
    std::uint64_t stride_;
};

}  // namespace

bool isMeshoptFallback(const Json& buffer) {
    const Json* extension = extensionOf(buffer);
    return extension != nullptr && extension->contains("fallback") && extension->at("fallback") == true;
}

void decodeMeshopt(Json& document, Asset& asset) {
    const auto views = document.find("bufferViews");
    if (views == document.end() || !views->is_array()) {
        return;
    }
    std::uint64_t bytes_left = AssetFolder::kMaxAssetBytes;
    std::size_t index = 0;
    for (Json& json : *views) {
        const std::string object = fmt::format("buffer view {}", index++);
        const Json* extension = extensionOf(json);
        if (extension == nullptr) {
            continue;
        }
        const View view(asset, *extension, object);
        const std::uint64_t size = view.decodedBytes();
        const auto length = json.find("byteLength");
        if (length == json.end() || !length->is_number_unsigned() || length->get<std::uint64_t>() != size) {
            view.fail(fmt::format("it holds {} bytes, which is not the view's byteLength", size));
        }
        if (size > bytes_left) {
            view.fail(fmt::format("the asset holds more than {} bytes", AssetFolder::kMaxAssetBytes));
        }
        bytes_left -= size;
        std::vector<std::byte> bytes = view.decode();
        json["buffer"] = asset.buffers.size();
        json["byteOffset"] = 0;
        asset.buffers.push_back(std::move(bytes));
    }
}

}  // namespace licht::gltf
