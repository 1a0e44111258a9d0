#include "licht/scene/describe.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "licht/core/json_text.h"
#include "licht/scene/effects.h"
#include "licht/scene/instancing.h"

namespace licht {
namespace {

using Json = nlohmann::ordered_json;

Json vectorOf(const vec3& v) {
    return {v.x, v.y, v.z};
}

std::string_view nameOf(PunctualLight::Kind kind) {
    switch (kind) {
        case PunctualLight::Kind::point:
            return "point";
        case PunctualLight::Kind::spot:
            return "spot";
        default:
            return "directional";
    }
}

struct Counts {
    std::size_t triangles = 0;  ///< as drawn: a mesh counts once per instance
    std::size_t vertices = 0;
    std::size_t stored_triangles = 0;  ///< a mesh that its instances share counts once
    std::size_t sharing_instances = 0;
    std::size_t texture_bytes = 0;
};

Counts count(const Scene& scene) {
    Counts counts;
    const Instancing instancing = chooseInstanced(scene);
    counts.sharing_instances = instancing.count;
    std::set<std::uint32_t> shared;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t index = scene.instances[i].mesh;
        const Mesh& mesh = scene.meshes[index];
        counts.triangles += mesh.triangles.size();
        counts.vertices += mesh.positions.size();
        if (instancing.instanced[i] == 0 || shared.insert(index).second) {
            counts.stored_triangles += mesh.triangles.size();
        }
    }
    for (const Texture& texture : scene.textures) {
        counts.texture_bytes += texture.bytes.size();
    }
    return counts;
}

Json describeContents(const Scene& scene) {
    const Counts counts = count(scene);
    Json json;
    json["name"] = scene.name;
    json["meshes"] = scene.meshes.size();
    json["instances"] = scene.instances.size();
    json["triangles"] = counts.triangles;
    json["vertices"] = counts.vertices;
    json["stored_triangles"] = counts.stored_triangles;
    json["sharing_instances"] = counts.sharing_instances;
    json["materials"] = scene.materials.size();
    json["texture_bytes"] = counts.texture_bytes;
    json["textures"] = Json::array();
    for (const Texture& t : scene.textures) {
        json["textures"].push_back({{"name", t.name},
                                    {"width", t.width},
                                    {"height", t.height},
                                    {"bits", t.bits},
                                    {"bytes", t.bytes.size()}});
    }
    json["cameras"] = Json::array();
    for (const Camera& c : scene.cameras) {
        json["cameras"].push_back(
            {{"name", c.name},
             {"kind", c.kind == Camera::Kind::perspective ? "perspective" : "orthographic"}});
    }
    json["lights"] = Json::array();
    for (const PunctualLight& l : scene.lights) {
        json["lights"].push_back(
            {{"name", l.name}, {"kind", nameOf(l.kind)}, {"intensity", vectorOf(l.intensity)}});
    }
    json["environment"] = nullptr;
    if (scene.environment) {
        json["environment"] = {{"name", scene.environment->name},
                               {"width", scene.environment->radiance.width},
                               {"height", scene.environment->radiance.height}};
    }
    const Bounds bounds = sceneBounds(scene);
    json["bounds"] = nullptr;
    if (!bounds.empty()) {
        json["bounds"] = {{"lower", vectorOf(bounds.lower)}, {"upper", vectorOf(bounds.upper)}};
    }
    json["origin"] = {scene.origin.x, scene.origin.y, scene.origin.z};
    return json;
}

Json describe(const Scene& scene) {
    Json json = describeContents(scene);
    json["notes"] = Json::array();
    for (const SceneNote& note : scene.notes) {
        json["notes"].push_back(
            {{"kind", note.kind == SceneNote::Kind::warning ? "warning" : "skipped"}, {"text", note.text}});
    }
    const Effects effects = detectEffects(scene);
    json["effects"] = {{"on", Json::array()}, {"off", Json::array()}};
    for (const EffectInfo& info : effectTable()) {
        if (effects.has(info.id)) {
            json["effects"]["on"].push_back(
                {{"name", info.name}, {"evidence", effects.evidence.at(info.id)}});
        } else {
            json["effects"]["off"].push_back(info.name);
        }
    }
    return json;
}

}  // namespace

std::string describeSceneJson(const Scene& scene) {
    return jsonText(describe(scene));
}

std::string describeSceneText(const Scene& scene) {
    const Counts counts = count(scene);
    const Bounds bounds = sceneBounds(scene);
    std::string text = fmt::format("scene '{}'\n", scene.name);
    text += fmt::format("  geometry     {} triangles, {} vertices, {} instances of {} meshes\n",
                        counts.triangles, counts.vertices, scene.instances.size(), scene.meshes.size());
    if (counts.sharing_instances > 0) {
        text += fmt::format("  in memory    {} triangles, {} instances share theirs\n",
                            counts.stored_triangles, counts.sharing_instances);
    }
    if (bounds.empty()) {
        text += "  bounds       empty\n";
    } else {
        text += fmt::format("  bounds       ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m\n",
                            bounds.lower.x, bounds.lower.y, bounds.lower.z, bounds.upper.x, bounds.upper.y,
                            bounds.upper.z);
    }
    if (scene.origin != glm::dvec3(0.0)) {
        text += fmt::format("  origin       ({:.10g}, {:.10g}, {:.10g}) m in the file's world\n",
                            scene.origin.x, scene.origin.y, scene.origin.z);
    }
    text += fmt::format("  materials    {}\n", scene.materials.size());
    text += fmt::format("  textures     {}, {:.1f} MiB\n", scene.textures.size(),
                        static_cast<double>(counts.texture_bytes) / (1024.0 * 1024.0));
    for (const Texture& t : scene.textures) {
        text += fmt::format("    '{}' {}x{}, {} bits, {} bytes\n", t.name, t.width, t.height, t.bits,
                            t.bytes.size());
    }
    text += fmt::format("  cameras      {}\n", scene.cameras.size());
    for (const Camera& c : scene.cameras) {
        text += fmt::format("    '{}' {}\n", c.name,
                            c.kind == Camera::Kind::perspective ? "perspective" : "orthographic");
    }
    text += fmt::format("  lights       {}\n", scene.lights.size());
    for (const PunctualLight& l : scene.lights) {
        text += fmt::format("    '{}' {}, ({:.4g}, {:.4g}, {:.4g}) {}\n", l.name, nameOf(l.kind),
                            l.intensity.x, l.intensity.y, l.intensity.z,
                            l.kind == PunctualLight::Kind::directional ? "lx" : "cd");
    }
    text += scene.environment
                ? fmt::format("  environment  '{}' {}x{}\n", scene.environment->name,
                              scene.environment->radiance.width, scene.environment->radiance.height)
                : "  environment  none\n";
    const Effects effects = detectEffects(scene);
    std::string off;
    text += "  effects on\n";
    for (const EffectInfo& info : effectTable()) {
        if (effects.has(info.id)) {
            text += fmt::format("    {:<15}{}\n", info.name, effects.evidence.at(info.id));
        } else {
            off += fmt::format(" {}", info.name);
        }
    }
    text += fmt::format("  effects off {}\n", off);
    for (const SceneNote& note : scene.notes) {
        text += fmt::format("  {}: {}\n", note.kind == SceneNote::Kind::warning ? "warning" : "skipped",
                            note.text);
    }
    return text;
}

}  // namespace licht
