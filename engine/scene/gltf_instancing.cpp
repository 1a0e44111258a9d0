#include "licht/scene/gltf_instancing.h"

#include <fmt/format.h>

#include <cmath>

#include "licht/scene/gltf_accessor.h"

namespace licht::gltf {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";
constexpr const char* kTranslation = "TRANSLATION";
constexpr const char* kRotation = "ROTATION";
constexpr const char* kScale = "SCALE";

/// Reads the attributes of one node; all have the length of the first.
class AttributeReader {
public:
    AttributeReader(const Asset& asset, const tinygltf::Value& attributes, std::string object)
        : asset_(asset), attributes_(attributes), object_(std::move(object)) {}

    template <typename Vector>
    std::vector<Vector> read(const char* name, bool may_be_normalized,
                             std::vector<Vector> (*elements)(const Asset&, int, std::string_view)) {
        if (!attributes_.Has(name)) {
            return {};
        }
        const tinygltf::Value& value = attributes_.Get(name);
        const std::string object = fmt::format("{}: {} {}", object_, kExtension, name);
        if (!value.IsInt()) {
            asset_.fail(object, "it is no index of an accessor");
        }
        const int index = value.GetNumberAsInt();
        const tinygltf::Accessor& accessor = at(asset_, asset_.model.accessors, index, object, "accessor");
        const bool normalized =
            accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_BYTE ||
                                    accessor.componentType == TINYGLTF_COMPONENT_TYPE_SHORT);
        if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !(may_be_normalized && normalized)) {
            asset_.fail(object, may_be_normalized
                                    ? "its components are neither floats nor normalised bytes or shorts"
                                    : "its components are not floats");
        }
        std::vector<Vector> values = elements(asset_, index, object);
        if (count_ && *count_ != values.size()) {
            asset_.fail(object, fmt::format("it has {} elements, the attribute before it {}", values.size(),
                                            *count_));
        }
        count_ = values.size();
        return values;
    }

    /// Throws where no attribute tells.
    [[nodiscard]] std::size_t count() const {
        if (!count_) {
            asset_.fail(object_, fmt::format("{} has none of TRANSLATION, ROTATION and SCALE", kExtension));
        }
        return *count_;
    }

private:
    const Asset& asset_;
    const tinygltf::Value& attributes_;
    std::string object_;
    std::optional<std::size_t> count_;
};

}  // namespace

std::optional<std::vector<glm::dmat4>> readInstances(Asset& asset, int node) {
    const tinygltf::Node& source = asset.model.nodes[static_cast<std::size_t>(node)];
    const auto extension = source.extensions.find(kExtension);
    if (extension == source.extensions.end()) {
        return std::nullopt;
    }
    const std::string object = objectName("node", static_cast<std::size_t>(node), source.name);
    if (!extension->second.IsObject() || !extension->second.Get("attributes").IsObject()) {
        asset.fail(object, fmt::format("{} has no attributes", kExtension));
    }
    AttributeReader reader(asset, extension->second.Get("attributes"), object);
    const std::vector<vec3> translations = reader.read<vec3>(kTranslation, false, readVec3);
    const std::vector<vec4> rotations = reader.read<vec4>(kRotation, true, readVec4);
    const std::vector<vec3> scales = reader.read<vec3>(kScale, false, readVec3);

    std::vector<glm::dmat4> transforms(reader.count(), glm::dmat4(1.0));
    for (std::size_t i = 0; i < transforms.size(); ++i) {
        glm::dmat4& m = transforms[i];
        if (!rotations.empty()) {
            const glm::dvec4 r(rotations[i]);
            const glm::dquat q(r.w, r.x, r.y, r.z);
            const double length = glm::length(q);
            if (length > 0.0 && std::isfinite(length)) {
                m = glm::mat4_cast(q / length);
            } else {
                asset.warn(fmt::format(
                    "{}: a rotation of its instances is no quaternion with a direction and taken as none",
                    object));
            }
        }
        if (!scales.empty()) {
            for (int axis = 0; axis < 3; ++axis) {
                m[axis] *= static_cast<double>(scales[i][axis]);
            }
        }
        if (!translations.empty()) {
            m[3] = glm::dvec4(glm::dvec3(translations[i]), 1.0);
        }
    }
    return transforms;
}

std::optional<std::vector<int>> instanceAccessors(const Asset& asset, int node) {
    const tinygltf::Node& source = asset.model.nodes[static_cast<std::size_t>(node)];
    const auto extension = source.extensions.find(kExtension);
    if (extension == source.extensions.end()) return std::nullopt;
    std::vector<int> accessors;
    if (extension->second.IsObject() && extension->second.Get("attributes").IsObject())
        for (const char* name : {kTranslation, kRotation, kScale}) {
            const tinygltf::Value& index = extension->second.Get("attributes").Get(name);
            if (index.IsInt()) accessors.push_back(index.GetNumberAsInt());
        }
    return accessors;
}

}  // namespace licht::gltf
