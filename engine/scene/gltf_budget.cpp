#include "licht/scene/gltf_budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "licht/core/memory.h"
#include "licht/scene/gltf_accessor.h"
#include "licht/scene/gltf_instancing.h"
#include "licht/shared/bvh_layout.h"

namespace licht::gltf {
namespace {

/// Of all accessors together, each reading counted.
constexpr auto kMostImplied = static_cast<double>(kMostImpliedElements);
/// The same, of instances, which take thirty times the memory.
constexpr double kMostImpliedInstances = 0x1p20;

/// Sums in doubles, which do not wrap.
class Budget {
public:
    explicit Budget(const Asset& asset) : asset_(asset) {}

    void addNode(int node) {
        const tinygltf::Node& source = asset_.model.nodes[static_cast<std::size_t>(node)];
        if (source.mesh < 0 || static_cast<std::size_t>(source.mesh) >= asset_.model.meshes.size()) return;
        const tinygltf::Mesh& mesh = asset_.model.meshes[static_cast<std::size_t>(source.mesh)];
        const std::string name = objectName("node", static_cast<std::size_t>(node), source.name);
        addInstances(node, mesh.primitives.size(), name);
        if (source.skin >= 0 && static_cast<std::size_t>(source.skin) < asset_.model.skins.size())
            count(asset_.model.skins[static_cast<std::size_t>(source.skin)].inverseBindMatrices);
        const bool of_its_own = source.skin != -1 || !source.weights.empty();
        if (!of_its_own && !shared_.insert(source.mesh).second) return;
        const std::vector<double>& weights = source.weights.empty() ? mesh.weights : source.weights;
        const std::string mesh_name = objectName("mesh", static_cast<std::size_t>(source.mesh), mesh.name);
        for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
            addPrimitive(mesh.primitives[p], weights, fmt::format("{} primitive {}", mesh_name, p));
    }

    void require() const {
        const std::string most =
            largest_ > 0.0 ? fmt::format(" (most of it {}: {})", largest_object_, largest_words_) : "";
        if (implied_ > kMostImplied)
            asset_.fail(largest_object_, fmt::format("accessors without bytes of their own stand for {:.0f} "
                                                     "elements in all, and at most {:.0f} are believed",
                                                     implied_, kMostImplied));
        if (implied_instances_ > kMostImpliedInstances)
            asset_.fail(largest_object_, fmt::format("accessors without bytes of their own place {:.0f} "
                                                     "instances in all, and at most {:.0f} are believed",
                                                     implied_instances_, kMostImpliedInstances));
        if (placed_ > double{kBvhMostTriangles})
            asset_.fail(largest_object_,
                        fmt::format("the scene places {:.0f} meshes, and at most {} can be traced", placed_,
                                    kBvhMostTriangles));
        requireMemory(bytes_, fmt::format("{}: its meshes and instances{} take", asset_.file, most));
    }

private:
    // What the loader keeps of an element, and has beside it while it reads: numbers as they were read.
    static constexpr double kBytesOfInstance = sizeof(Instance) + 2.0 * sizeof(glm::dmat4);
    static constexpr double kBytesOfIndex = 2.0 * sizeof(std::uint32_t) + sizeof(uvec3) / 3.0;

    /// Elements of an accessor; 0 where there is none, which readers refuse.
    double count(int accessor, bool instances = false) {
        if (accessor < 0 || static_cast<std::size_t>(accessor) >= asset_.model.accessors.size()) return 0.0;
        const tinygltf::Accessor& source = asset_.model.accessors[static_cast<std::size_t>(accessor)];
        const auto elements = static_cast<double>(source.count);
        if (source.bufferView < 0) {
            (instances ? implied_instances_ : implied_) += elements;
            return elements;
        }
        const auto& views = asset_.model.bufferViews;
        const auto view = static_cast<std::size_t>(source.bufferView);
        // No more than there are bytes for; readers refuse what lies.
        return view < views.size() ? std::min(elements, static_cast<double>(views[view].byteLength)) : 0.0;
    }

    void add(double bytes, const std::string& object, double elements, std::string_view what) {
        bytes_ += bytes;
        if (bytes <= largest_) return;
        largest_ = bytes;
        largest_object_ = object;
        largest_words_ = fmt::format("{:.0f} {}", elements, what);
    }

    void addInstances(int node, std::size_t primitives, const std::string& name) {
        double instances = 1.0;
        if (const auto accessors = instanceAccessors(asset_, node)) {
            instances = 0.0;
            for (const int accessor : *accessors) instances = std::max(instances, count(accessor, true));
        }
        placed_ += instances * static_cast<double>(primitives);
        add(kBytesOfInstance * instances * static_cast<double>(std::max<std::size_t>(primitives, 1)), name,
            instances, "instances");
    }

    void addPrimitive(const tinygltf::Primitive& primitive, const std::vector<double>& weights,
                      const std::string& object) {
        double vertices = 0.0;
        double bytes = 0.0;
        for (const auto& [name, accessor] : primitive.attributes) {
            const double elements = count(accessor);
            if (name == "POSITION") vertices = elements;
            // As four floats or numbers, and as they are read.
            bytes += 2.0 * sizeof(vec4) * elements;
        }
        for (std::size_t t = 0; t < std::min(primitive.targets.size(), weights.size()); ++t)
            if (weights[t] != 0.0)
                for (const auto& target : primitive.targets[t]) count(target.second);
        const double indices = primitive.indices < 0 ? vertices : count(primitive.indices);
        const bool strip =
            primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP || primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        add(bytes + kBytesOfIndex * (strip ? 3.0 : 1.0) * indices, object, std::max(vertices, indices),
            vertices >= indices ? "vertices" : "indices");
    }

    const Asset& asset_;
    std::set<int> shared_;
    double bytes_ = 0.0;
    double implied_ = 0.0;
    double implied_instances_ = 0.0;
    double placed_ = 0.0;
    double largest_ = 0.0;
    std::string largest_object_ = "the scene";
    std::string largest_words_;
};

}  // namespace

void requireBudget(const Asset& asset, const NodeTree& tree) {
    Budget budget(asset);
    for (const int node : tree.visible) budget.addNode(node);
    budget.require();
}

}  // namespace licht::gltf
