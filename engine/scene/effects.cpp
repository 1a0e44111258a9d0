#include "licht/scene/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "licht/colour/transfer.h"
#include "licht/scene/emitter_shapes.h"
#include "licht/scene/instancing.h"
#include "licht/scene/slot_table.h"

namespace licht {

const std::array<EffectInfo, kEffectCount>& effectTable() {
    static constexpr std::array<EffectInfo, kEffectCount> kTable{{
        {kEffectTextures, "textures", "materials read textures", "texels,textures", "gbuffer,path"},
        {kEffectNormalMaps, "normalMaps", "normal maps bend the shading frame", "tangents", "path"},
        {kEffectVertexColors, "vertexColors", "vertices carry colours", "colors", "gbuffer,path"},
        {kEffectExtraUvSets, "extraUvSets", "textures read more than the first set of coordinates",
         "extra_uvs", "gbuffer,path"},
        {kEffectAlpha, "alpha", "surfaces with holes or partial coverage", "", "gbuffer,path"},
        {kEffectGlossy, "glossy", "microfacet reflection", "", "path"},
        {kEffectEmission, "emission", "surfaces that emit light", "", "path"},
        {kEffectLightTriangles, "lightTriangles", "emissive triangles are sampled as lights",
         "lights,light_alias", "path"},
        {kEffectPunctualLights, "punctualLights", "point, spot and directional lights", "lights,light_alias",
         "path"},
        {kEffectEnvironment, "environment", "light from infinitely far", "environment_map,environment_table",
         "path"},
        {kEffectUnlit, "unlit", "surfaces that show their colour without light", "", "path"},
        {kEffectIridescence, "iridescence", "thin films colour what reflects", "", "path"},
        {kEffectInstances, "instances", "meshes are stored once and placed often", "instance_transforms",
         "gbuffer,path"},
        {kEffectLightSpheres, "lightSpheres", "round meshes that shine are sampled as one light each", "",
         "path"},
        {kEffectSuns, "suns", "directional lights that are seen as discs", "lights", "path"},
    }};
    return kTable;
}

std::vector<std::string> Effects::names() const {
    std::vector<std::string> result;
    for (const EffectInfo& info : effectTable()) {
        if (has(info.id)) {
            result.emplace_back(info.name);
        }
    }
    return result;
}

namespace {

bool anyPositive(const vec3& v) {
    return v.x > 0.0F || v.y > 0.0F || v.z > 0.0F;
}

bool emits(const Material& m) {
    return !m.unlit && anyPositive(m.emission);
}

/// Whatever ior and specular colour: at grazing angles Schlick's curve rises to `specular`
/// (KHR_materials_specular), even from zero.
bool dielectricReflects(const Material& m) {
    return m.specular > 0.0F;
}

bool iridescent(const Material& m) {
    const float thickest = m.slots[kSlotIridescenceThickness].present()
                               ? std::max(m.iridescence.thickness_minimum, m.iridescence.thickness_maximum)
                               : m.iridescence.thickness_maximum;
    return !m.unlit && m.iridescence.factor > 0.0F && thickest > 0.0F;
}

/// A thin film reflects by itself, whatever lies under it.
bool glossy(const Material& m) {
    return !m.unlit && (m.metallic > 0.0F || dielectricReflects(m) || iridescent(m));
}

bool hasColors(const Mesh& mesh) {
    return std::any_of(mesh.colors.begin(), mesh.colors.end(), [](const vec4& c) { return c != vec4(1.0F); });
}

/// False where every point is surely kept whole.
bool alphaMatters(const Material& m, const Mesh& mesh) {
    if (m.alpha_mode == AlphaMode::opaque) {
        return false;
    }
    const float whole = m.alpha_mode == AlphaMode::mask ? m.alpha_cutoff : 1.0F;
    return m.slots[kSlotBaseColor].present() || hasColors(mesh) || m.base_color.w < whole;
}

bool bendsNormals(const Material& m) {
    return !m.unlit && m.slots[kSlotNormal].present() && m.normal_scale != 0.0F;
}

/// Whether what a slot reads can change a picture, slot by slot.
using Influence = bool (*)(const Material&, const Mesh&);
constexpr std::array<Influence, kSlotCount> kInfluence = [] {
    std::array<Influence, kSlotCount> table{};
    table[kSlotBaseColor] = [](const Material& m, const Mesh& mesh) {
        return anyPositive(vec3(m.base_color)) || alphaMatters(m, mesh);
    };
    table[kSlotMetallicRoughness] = [](const Material& m, const Mesh&) { return glossy(m); };
    table[kSlotNormal] = [](const Material& m, const Mesh&) { return bendsNormals(m); };
    table[kSlotEmissive] = [](const Material& m, const Mesh&) { return emits(m); };
    table[kSlotSpecular] = [](const Material& m, const Mesh&) { return !m.unlit && dielectricReflects(m); };
    table[kSlotSpecularColor] = table[kSlotSpecular];
    table[kSlotIridescence] = [](const Material& m, const Mesh&) { return iridescent(m); };
    table[kSlotIridescenceThickness] = table[kSlotIridescence];
    return table;
}();
static_assert(std::find(kInfluence.begin(), kInfluence.end(), nullptr) == kInfluence.end());

/// How much of a surface an emissive texture lights: the mean of its emission over the maximum. 1 without a
/// texture, 0 for a black one.
double litShare(const Scene& scene, const Material& m) {
    if (!m.slots[kSlotEmissive].present()) {
        return 1.0;
    }
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        linear.at(i) = static_cast<double>(linearFromSrgb(static_cast<float>(i) / 255.0F));
    }
    const Texture& texture = scene.textures[m.slots[kSlotEmissive].texture];
    const std::size_t channel_bytes = texture.bits / 8;
    const std::size_t texels = std::size_t{texture.width} * texture.height;
    double sum = 0.0;
    double most = 0.0;
    for (std::size_t i = 0; i < texels; ++i) {
        double light = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            // The last byte of a little-endian channel is its highest.
            const std::uint8_t high = texture.bytes[(4 * i + c) * channel_bytes + channel_bytes - 1];
            light += linear.at(high) * static_cast<double>(m.emission[static_cast<int>(c)]);
        }
        sum += light;
        most = std::max(most, light);
    }
    return most > 0.0 ? sum / most / static_cast<double>(texels) : 0.0;
}

/// World-space area in m^2.
double area(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::dmat3 linear(instance.world_from_object);
    double sum = 0.0;
    for (const uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]);
        const glm::dvec3 b(mesh.positions[t.y]);
        const glm::dvec3 c(mesh.positions[t.z]);
        sum += 0.5 * glm::length(glm::cross(linear * (b - a), linear * (c - a)));
    }
    return sum;
}

class Detector {
public:
    explicit Detector(const Scene& scene) : scene_(scene) {}

    Effects run() {
        std::set<std::uint32_t> used_meshes;
        for (const Instance& instance : scene_.instances) {
            if (used_meshes.insert(instance.mesh).second) {
                lookAt(scene_.meshes[instance.mesh]);
            }
        }
        lookAtLights();
        lookAtEmittingArea();
        if (const Instancing instancing = chooseInstanced(scene_); instancing.count > 0) {
            call(kEffectInstances,
                 fmt::format("mesh '{}' is used {} times", scene_.meshes[instancing.most_used].name,
                             instancing.most_uses));
        }
        return std::move(effects_);
    }

private:
    void call(uint effect, std::string evidence) {
        if (!effects_.on.at(effect)) {
            effects_.on.at(effect) = true;
            effects_.evidence.at(effect) = std::move(evidence);
        }
    }

    void lookAt(const Mesh& mesh) {
        if (mesh.triangles.empty()) {
            return;
        }
        const Material& m = scene_.materials[mesh.material];
        for (const SlotInfo& info : kSlotTable) {
            const TextureSlot& slot = m.slots[info.kind];
            if (!slot.present() || !kInfluence[info.kind](m, mesh)) {
                continue;
            }
            call(kEffectTextures, fmt::format("material '{}' has a {} texture", m.name, info.name));
            if (slot.uv_set > 0) {
                call(kEffectExtraUvSets, fmt::format("material '{}' reads its {} texture by TEXCOORD_{}",
                                                     m.name, info.name, slot.uv_set));
            }
        }
        if (bendsNormals(m)) {
            call(kEffectNormalMaps, fmt::format("material '{}' has a normal map", m.name));
        }
        if (hasColors(mesh)) {
            call(kEffectVertexColors, fmt::format("mesh '{}' has vertex colours", mesh.name));
        }
        if (alphaMatters(m, mesh)) {
            call(kEffectAlpha, fmt::format("material '{}' has alpha mode {}", m.name,
                                           m.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND"));
        }
        if (glossy(m)) {
            call(kEffectGlossy, m.metallic > 0.0F
                                    ? fmt::format("material '{}' is metallic", m.name)
                                    : fmt::format("material '{}' reflects at its surface", m.name));
        }
        if (emits(m)) {
            call(kEffectEmission, fmt::format("material '{}' emits", m.name));
        }
        if (iridescent(m)) {
            call(kEffectIridescence, fmt::format("material '{}' is iridescent", m.name));
        }
        if (m.unlit) {
            call(kEffectUnlit, fmt::format("material '{}' is unlit", m.name));
        }
    }

    void lookAtLights() {
        for (const PunctualLight& light : scene_.lights) {
            if (anyPositive(light.intensity)) {
                call(kEffectPunctualLights, fmt::format("light '{}' shines", light.name));
                if (fillsAngle(light)) {
                    call(kEffectSuns, fmt::format("light '{}' fills {:.3g} degrees", light.name,
                                                  glm::degrees(light.angular_diameter)));
                }
            }
        }
        if (scene_.environment) {
            const auto& texels = scene_.environment->radiance.texels;
            if (std::any_of(texels.begin(), texels.end(), [](float x) { return x > 0.0F; })) {
                call(kEffectEnvironment,
                     fmt::format("environment '{}' is not black", scene_.environment->name));
            }
        }
    }

    /// Where most of the surface shines, scattered rays find the light by themselves and without noise (a
    /// closed furnace has none at all); sampling its triangles too would only add noise. So they are sampled
    /// while they are less than half of the area, where a textured surface counts by its lit share.
    void lookAtEmittingArea() {
        if (!effects_.has(kEffectEmission)) {
            return;
        }
        double all = 0.0;
        double emitting = 0.0;
        std::string first;
        for (const Instance& instance : scene_.instances) {
            const Mesh& mesh = scene_.meshes[instance.mesh];
            const double a = area(scene_, instance);
            all += a;
            if (const Material& m = scene_.materials[mesh.material];
                emits(m) && a > 0.0 && litShare(m) > 0.0) {
                emitting += a * litShare(m);
                first = first.empty() ? mesh.name : first;
            }
        }
        if (emitting > 0.0 && emitting < 0.5 * all) {
            call(kEffectLightTriangles, fmt::format("mesh '{}' emits, and {:.3g} % of all surface does",
                                                    first, 100.0 * emitting / all));
            lookForRoundEmitters();
        }
    }

    void lookForRoundEmitters() {
        for (const Instance& instance : scene_.instances) {
            if (roundEmitter(scene_, instance)) {
                call(kEffectLightSpheres, fmt::format("mesh '{}' shines and is nearly a sphere",
                                                      scene_.meshes[instance.mesh].name));
                return;
            }
        }
    }

    double litShare(const Material& m) {
        const auto [known, added] = lit_shares_.try_emplace(&m, 0.0);
        if (added) {
            known->second = licht::litShare(scene_, m);
        }
        return known->second;
    }

    const Scene& scene_;
    Effects effects_;
    std::map<const Material*, double> lit_shares_;
};

}  // namespace

Effects detectEffects(const Scene& scene) {
    return Detector(scene).run();
}

Effects allEffects() {
    Effects effects;
    effects.on.fill(true);
    effects.evidence.fill("asked for");
    return effects;
}

bool isDark(const Scene& scene) {
    const Effects effects = detectEffects(scene);
    return !effects.has(kEffectEmission) && !effects.has(kEffectPunctualLights) &&
           !effects.has(kEffectEnvironment) && !effects.has(kEffectUnlit);
}

}  // namespace licht
