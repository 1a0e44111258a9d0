#include "licht/scene/gltf_accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace licht::gltf {
namespace {

std::size_t componentBytes(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

/// `count` elements of `size` bytes, `stride` bytes apart, starting at `first`: all inside of their view.
struct Elements {
    const std::byte* first = nullptr;
    std::size_t stride = 0;
};

Elements elementsOf(const Asset& asset, int view, std::uint64_t offset, std::uint64_t stride,
                    std::uint64_t size, std::uint64_t count, const std::string& object) {
    const std::span<const std::byte> bytes = viewBytes(asset, view, object);
    if (count == 0) {
        return {};
    }
    const bool fits = offset <= bytes.size() && size <= bytes.size() - offset &&
                      (count - 1) <= (bytes.size() - offset - size) / stride;
    if (!fits) {
        asset.fail(
            object,
            fmt::format(
                "{} elements of {} bytes from byte {} on do not fit into the {} bytes of buffer view {}",
                count, size, offset, bytes.size(), view));
    }
    return {bytes.data() + offset, stride};
}

template <typename Stored, typename Value>
Value convert(const std::byte* source, bool normalized) {
    Stored stored{};
    std::memcpy(&stored, source, sizeof(Stored));
    if constexpr (std::is_integral_v<Stored> && std::is_floating_point_v<Value>) {
        if (normalized) {
            // glTF 2.0, 3.6.2.2: c / max, and the lowest signed value clamps to -1.
            return std::max(
                static_cast<Value>(stored) / static_cast<Value>(std::numeric_limits<Stored>::max()),
                Value(-1));
        }
    }
    return static_cast<Value>(stored);
}

/// Reads one component; the caller has checked the type.
template <typename Value>
Value component(const std::byte* source, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return convert<std::int8_t, Value>(source, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return convert<std::uint8_t, Value>(source, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return convert<std::int16_t, Value>(source, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return convert<std::uint16_t, Value>(source, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return convert<std::uint32_t, Value>(source, normalized);
        default:
            if constexpr (std::is_floating_point_v<Value>) {
                return convert<float, Value>(source, normalized);
            }
            return Value{};
    }
}

bool isUnsignedInteger(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// An accessor being read into an array of components.
template <typename Value>
class Reader {
public:
    Reader(const Asset& asset, int accessor, std::string_view object)
        : asset_(asset),
          accessor_(at(asset, asset.model.accessors, accessor, object, "accessor")),
          object_(fmt::format("{}: {}", object,
                              objectName("accessor", static_cast<std::size_t>(accessor), accessor_.name))),
          components_(static_cast<std::size_t>(
              tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor_.type)))),
          component_bytes_(componentBytes(accessor_.componentType)) {
        const bool known =
            std::is_floating_point_v<Value>
                ? component_bytes_ > 0 && accessor_.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT
                : isUnsignedInteger(accessor_.componentType);
        if (!known) {
            asset_.fail(object_,
                        fmt::format("component type {} is not allowed here", accessor_.componentType));
        }
        if (accessor_.count >= kNone ||
            (accessor_.bufferView < 0 && accessor_.count > kMostImpliedElements)) {
            asset_.fail(object_, fmt::format("{} elements are too many", accessor_.count));
        }
    }

    [[nodiscard]] std::size_t components() const { return components_; }

    std::vector<Value> read(std::size_t components) {
        if (components != components_) {
            asset_.fail(object_, fmt::format("it has {} components, {} are wanted", components_, components));
        }
        std::vector<Value> values;
        const std::size_t size = components_ * component_bytes_;
        if (accessor_.bufferView >= 0) {
            const tinygltf::BufferView& view =
                at(asset_, asset_.model.bufferViews, accessor_.bufferView, object_, "buffer view");
            const Elements elements =
                elementsOf(asset_, accessor_.bufferView, accessor_.byteOffset,
                           view.byteStride == 0 ? size : view.byteStride, size, accessor_.count, object_);
            values.resize(accessor_.count * components_);
            for (std::size_t i = 0; i < accessor_.count; ++i) {
                copyElement(elements.first + i * elements.stride, values.data() + i * components_);
            }
        } else {
            values.resize(accessor_.count * components_);
        }
        if (accessor_.sparse.isSparse) {
            overrideSparse(values, size);
        }
        return values;
    }

private:
    void copyElement(const std::byte* source, Value* target) const {
        for (std::size_t c = 0; c < components_; ++c) {
            target[c] = component<Value>(source + c * component_bytes_, accessor_.componentType,
                                         accessor_.normalized);
        }
    }

    void overrideSparse(std::vector<Value>& values, std::size_t size) const {
        const auto& sparse = accessor_.sparse;
        const auto count = static_cast<std::size_t>(sparse.count);
        if (count > accessor_.count || !isUnsignedInteger(sparse.indices.componentType)) {
            asset_.fail(object_, "its sparse part is damaged");
        }
        const std::size_t index_bytes = componentBytes(sparse.indices.componentType);
        const Elements indices = elementsOf(asset_, sparse.indices.bufferView,
                                            static_cast<std::uint64_t>(sparse.indices.byteOffset),
                                            index_bytes, index_bytes, count, object_);
        const Elements replacements =
            elementsOf(asset_, sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset),
                       size, size, count, object_);
        for (std::size_t i = 0; i < count; ++i) {
            const auto index = component<std::uint32_t>(indices.first + i * indices.stride,
                                                        sparse.indices.componentType, false);
            if (index >= accessor_.count) {
                asset_.fail(object_,
                            fmt::format("sparse index {} is not below its count {}", index, accessor_.count));
            }
            copyElement(replacements.first + i * replacements.stride, values.data() + index * components_);
        }
    }

    const Asset& asset_;
    const tinygltf::Accessor& accessor_;
    std::string object_;
    std::size_t components_;
    std::size_t component_bytes_;
};

template <typename Vector>
std::vector<Vector> readVectors(const Asset& asset, int accessor, std::string_view object) {
    using Value = typename Vector::value_type;
    constexpr std::size_t kComponents = sizeof(Vector) / sizeof(Value);
    const std::vector<Value> values = Reader<Value>(asset, accessor, object).read(kComponents);
    std::vector<Vector> vectors(values.size() / kComponents);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        std::memcpy(&vectors[i][0], values.data() + i * kComponents, sizeof(Vector));
    }
    return vectors;
}

}  // namespace

std::vector<vec2> readVec2(const Asset& asset, int accessor, std::string_view object) {
    return readVectors<vec2>(asset, accessor, object);
}
std::vector<vec3> readVec3(const Asset& asset, int accessor, std::string_view object) {
    return readVectors<vec3>(asset, accessor, object);
}
std::vector<vec4> readVec4(const Asset& asset, int accessor, std::string_view object) {
    return readVectors<vec4>(asset, accessor, object);
}
std::vector<mat4> readMat4(const Asset& asset, int accessor, std::string_view object) {
    return readVectors<mat4>(asset, accessor, object);
}

std::vector<vec4> readColors(const Asset& asset, int accessor, std::string_view object) {
    Reader<float> reader(asset, accessor, object);
    const std::size_t components = reader.components() == 3 ? 3 : 4;
    const std::vector<float> values = reader.read(components);
    std::vector<vec4> colors(values.size() / components, vec4(1.0F));
    for (std::size_t i = 0; i < colors.size(); ++i) {
        std::memcpy(&colors[i], values.data() + i * components, components * sizeof(float));
    }
    return colors;
}

std::vector<std::uint32_t> readIndices(const Asset& asset, int accessor, std::string_view object) {
    return Reader<std::uint32_t>(asset, accessor, object).read(1);
}
std::vector<uvec4> readJoints(const Asset& asset, int accessor, std::string_view object) {
    return readVectors<uvec4>(asset, accessor, object);
}

}  // namespace licht::gltf
