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

bool clearcoated(const Material& m) {
    return !m.unlit && m.clearcoat.factor > 0.0F;
}

/// A thin film and a clearcoat reflect by themselves, whatever lies under them.
bool glossy(const Material& m) {
    return !m.unlit && (m.metallic > 0.0F || dielectricReflects(m) || iridescent(m) || clearcoated(m));
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
    return !m.unlit && m.normalMap() != nullptr;
}

/// Whether what a slot reads can change a picture, slot by slot.
using Influence = bool (*)(const Material&, const Mesh&);
constexpr std::array<Influence, kSlotCount> kInfluence = [] {
    std::array<Influence, kSlotCount> table{};
    table[kSlotBaseColor] = [](const Material& m, const Mesh& mesh) {
        return anyPositive(vec3(m.base_color)) || alphaMatters(m, mesh);
    };
    table[kSlotMetallicRoughness] = [](const Material& m, const Mesh&) { return glossy(m); };
    table[kSlotNormal] = [](const Material& m, const Mesh&) { return !m.unlit && m.normal_scale != 0.0F; };
    table[kSlotEmissive] = [](const Material& m, const Mesh&) { return emits(m); };
    table[kSlotSpecular] = [](const Material& m, const Mesh&) { return !m.unlit && dielectricReflects(m); };
    table[kSlotSpecularColor] = table[kSlotSpecular];
    table[kSlotIridescence] = [](const Material& m, const Mesh&) { return iridescent(m); };
    table[kSlotIridescenceThickness] = table[kSlotIridescence];
    table[kSlotClearcoat] = [](const Material& m, const Mesh&) { return clearcoated(m); };
    table[kSlotClearcoatRoughness] = table[kSlotClearcoat];
    table[kSlotClearcoatNormal] = [](const Material& m, const Mesh&) {
        return clearcoated(m) && m.clearcoat.normal_scale != 0.0F;
    };
    return table;
}();
static_assert(std::find(kInfluence.begin(), kInfluence.end(), nullptr) == kInfluence.end());

/// What a material emits, by all three channels: where it is brightest, and on average.
struct Emission {
    double brightest = 0.0;
    double mean = 0.0;
};

Emission emissionOf(const Scene& scene, const Material& m) {
    if (!emits(m)) {
        return {};
    }
    if (!m.slots[kSlotEmissive].present()) {
        const double sum = static_cast<double>(m.emission.x) + static_cast<double>(m.emission.y) +
                           static_cast<double>(m.emission.z);
        return {sum, sum};
    }
    std::array<double, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        linear.at(i) = static_cast<double>(linearFromSrgb(static_cast<float>(i) / 255.0F));
    }
    const Texture& texture = scene.textures[m.slots[kSlotEmissive].texture];
    const std::size_t channel_bytes = texture.bits / 8;
    const std::size_t texels = std::size_t{texture.width} * texture.height;
    Emission emission;
    for (std::size_t i = 0; i < texels; ++i) {
        double light = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            // The last byte of a little-endian channel is its highest.
            const std::uint8_t high = texture.bytes[(4 * i + c) * channel_bytes + channel_bytes - 1];
            light += linear.at(high) * static_cast<double>(m.emission[static_cast<int>(c)]);
        }
        emission.mean += light / static_cast<double>(texels);
        emission.brightest = std::max(emission.brightest, light);
    }
    return emission;
}

std::vector<Emission> emissionsOf(const Scene& scene) {
    std::vector<Emission> emissions;
    for (const Material& m : scene.materials) {
        emissions.push_back(emissionOf(scene, m));
    }
    return emissions;
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

}  // namespace

/// What evidence is looked for in.
struct LookedAt {
    const Scene& scene;
    std::vector<const Mesh*> meshes;  ///< with triangles and in use, each once
    std::vector<Emission> emissions;  ///< by material
    const Effects& above;             ///< rows before this one are decided
};

namespace {

const Material& materialOf(const LookedAt& at, const Mesh& mesh) {
    return at.scene.materials[mesh.material];
}

/// What `say` says of the first mesh of which it says anything.
template <typename Say>
std::string ofFirstMesh(const LookedAt& at, const Say& say) {
    for (const Mesh* mesh : at.meshes)
        if (std::string said = say(*mesh, materialOf(at, *mesh)); !said.empty()) return said;
    return {};
}

/// The same, of materials that fit.
template <typename Fits>
std::string ofFirstMaterial(const LookedAt& at, const Fits& fits, std::string_view says) {
    return ofFirstMesh(at, [&](const Mesh&, const Material& m) {
        return fits(m) ? fmt::format("material '{}' {}", m.name, says) : std::string();
    });
}

/// What `say` says of the first slot that reads a texture and can change a picture.
template <typename Say>
std::string ofFirstSlot(const LookedAt& at, const Say& say) {
    return ofFirstMesh(at, [&](const Mesh& mesh, const Material& m) {
        for (const SlotInfo& info : kSlotTable) {
            const TextureSlot& slot = m.slots[info.kind];
            if (!slot.present() || !kInfluence[info.kind](m, mesh)) continue;
            if (std::string said = say(m, info, slot); !said.empty()) return said;
        }
        return std::string();
    });
}

std::string texturesOf(const LookedAt& at) {
    return ofFirstSlot(at, [](const Material& m, const SlotInfo& info, const TextureSlot&) {
        return fmt::format("material '{}' has a {} texture", m.name, info.name);
    });
}

std::string extraUvSetsOf(const LookedAt& at) {
    return ofFirstSlot(at, [](const Material& m, const SlotInfo& info, const TextureSlot& slot) {
        return slot.uv_set > 0 ? fmt::format("material '{}' reads its {} texture by TEXCOORD_{}", m.name,
                                             info.name, slot.uv_set)
                               : std::string();
    });
}

std::string vertexColorsOf(const LookedAt& at) {
    return ofFirstMesh(at, [](const Mesh& mesh, const Material&) {
        return hasColors(mesh) ? fmt::format("mesh '{}' has vertex colours", mesh.name) : std::string();
    });
}

std::string alphaOf(const LookedAt& at) {
    return ofFirstMesh(at, [](const Mesh& mesh, const Material& m) {
        return alphaMatters(m, mesh) ? fmt::format("material '{}' has alpha mode {}", m.name,
                                                   m.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND")
                                     : std::string();
    });
}

std::string glossOf(const LookedAt& at) {
    return ofFirstMesh(at, [](const Mesh&, const Material& m) {
        if (!glossy(m)) return std::string();
        return fmt::format("material '{}' {}", m.name,
                           m.metallic > 0.0F ? "is metallic" : "reflects at its surface");
    });
}

std::string emissionEvidence(const LookedAt& at) {
    return ofFirstMesh(at, [&](const Mesh& mesh, const Material& m) {
        return at.emissions[mesh.material].brightest > 0.0 ? fmt::format("material '{}' emits", m.name)
                                                           : std::string();
    });
}

/// Where most of the surface shines, scattered rays find the light by themselves and without noise (a closed
/// furnace has none at all); sampling its triangles too would only add noise. So they are sampled while they
/// are less than half of the area, where a textured surface counts by its lit share.
std::string lightTrianglesOf(const LookedAt& at) {
    if (!at.above.has(kEffectEmission)) return {};
    double all = 0.0;
    double emitting = 0.0;
    std::string first;
    for (const Instance& instance : at.scene.instances) {
        const Mesh& mesh = at.scene.meshes[instance.mesh];
        const double a = area(at.scene, instance);
        all += a;
        const Emission& emission = at.emissions[mesh.material];
        if (emission.brightest <= 0.0 || a <= 0.0) continue;
        emitting += a * emission.mean / emission.brightest;
        first = first.empty() ? mesh.name : first;
    }
    if (emitting <= 0.0 || emitting >= 0.5 * all) return {};
    return fmt::format("mesh '{}' emits, and {:.3g} % of all surface does", first, 100.0 * emitting / all);
}

std::string lightSpheresOf(const LookedAt& at) {
    if (!at.above.has(kEffectLightTriangles)) return {};
    for (const Instance& instance : at.scene.instances)
        if (roundEmitter(at.scene, instance))
            return fmt::format("mesh '{}' shines and is nearly a sphere",
                               at.scene.meshes[instance.mesh].name);
    return {};
}

std::string punctualLightsOf(const LookedAt& at) {
    for (const PunctualLight& light : at.scene.lights)
        if (anyPositive(light.intensity)) return fmt::format("light '{}' shines", light.name);
    return {};
}

std::string sunsOf(const LookedAt& at) {
    for (const PunctualLight& light : at.scene.lights)
        if (anyPositive(light.intensity) && fillsAngle(light))
            return fmt::format("light '{}' fills {:.3g} degrees", light.name,
                               glm::degrees(light.angular_diameter));
    return {};
}

std::string environmentOf(const LookedAt& at) {
    if (!at.scene.environment) return {};
    const auto& texels = at.scene.environment->radiance.texels;
    return std::any_of(texels.begin(), texels.end(), [](float x) { return x > 0.0F; })
               ? fmt::format("environment '{}' is not black", at.scene.environment->name)
               : std::string();
}

std::string instancesOf(const LookedAt& at) {
    const Instancing instancing = chooseInstanced(at.scene);
    return instancing.count > 0
               ? fmt::format("mesh '{}' is used {} times", at.scene.meshes[instancing.most_used].name,
                             instancing.most_uses)
               : std::string();
}

constexpr std::array<EffectInfo, kEffectCount> kEffectTable{{
    {kEffectTextures, "textures", "materials read textures", texturesOf},
    {kEffectNormalMaps, "normalMaps", "normal maps bend the shading frame",
     [](const LookedAt& at) { return ofFirstMaterial(at, bendsNormals, "has a normal map"); }},
    {kEffectVertexColors, "vertexColors", "vertices carry colours", vertexColorsOf},
    {kEffectExtraUvSets, "extraUvSets", "textures read more than the first set of coordinates",
     extraUvSetsOf},
    {kEffectAlpha, "alpha", "surfaces with holes or partial coverage", alphaOf},
    {kEffectGlossy, "glossy", "microfacet reflection", glossOf},
    {kEffectEmission, "emission", "surfaces that emit light", emissionEvidence},
    {kEffectLightTriangles, "lightTriangles", "emissive triangles are sampled as lights", lightTrianglesOf},
    {kEffectPunctualLights, "punctualLights", "point, spot and directional lights", punctualLightsOf},
    {kEffectEnvironment, "environment", "light from infinitely far", environmentOf},
    {kEffectUnlit, "unlit", "surfaces that show their colour without light",
     [](const LookedAt& at) {
         return ofFirstMaterial(
             at, [](const Material& m) { return m.unlit; }, "is unlit");
     }},
    {kEffectIridescence, "iridescence", "thin films colour what reflects",
     [](const LookedAt& at) { return ofFirstMaterial(at, iridescent, "is iridescent"); }},
    {kEffectInstances, "instances", "meshes are stored once and placed often", instancesOf},
    {kEffectLightSpheres, "lightSpheres", "round meshes that shine are sampled as one light each",
     lightSpheresOf},
    {kEffectSuns, "suns", "directional lights that are seen as discs", sunsOf},
    {kEffectClearcoat, "clearcoat", "clear layers over everything else",
     [](const LookedAt& at) { return ofFirstMaterial(at, clearcoated, "has a clearcoat"); }},
}};

/// Whether row i is about the effect i.
constexpr bool effectsAreInOrder() {
    for (uint id = 0; id < kEffectCount; ++id)
        if (kEffectTable[id].id != id) return false;
    return true;
}
static_assert(effectsAreInOrder());

}  // namespace

const std::array<EffectInfo, kEffectCount>& effectTable() {
    return kEffectTable;
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

void Effects::addTo(std::map<std::uint32_t, std::uint32_t>& constants) const {
    for (uint effect = 0; effect < kEffectCount; ++effect) constants[effect] = has(effect) ? 1U : 0U;
}

Effects detectEffects(const Scene& scene) {
    Effects effects;
    LookedAt at{scene, {}, emissionsOf(scene), effects};
    std::set<std::uint32_t> seen;
    for (const Instance& instance : scene.instances)
        if (seen.insert(instance.mesh).second && !scene.meshes[instance.mesh].triangles.empty())
            at.meshes.push_back(&scene.meshes[instance.mesh]);
    for (const EffectInfo& info : kEffectTable) {
        effects.evidence[info.id] = info.evidence(at);
        effects.on[info.id] = !effects.evidence[info.id].empty();
    }
    return effects;
}

Effects allEffects() {
    Effects effects;
    effects.on.fill(true);
    effects.evidence.fill("asked for");
    return effects;
}

float brightestEmission(const Scene& scene) {
    const std::vector<Emission> emissions = emissionsOf(scene);
    double brightest = 0.0;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (!mesh.triangles.empty()) brightest = std::max(brightest, emissions[mesh.material].brightest);
    }
    return static_cast<float>(brightest / 3.0);
}

bool isDark(const Scene& scene) {
    const Effects effects = detectEffects(scene);
    const bool all_unlit =
        !scene.instances.empty() && std::ranges::all_of(scene.instances, [&](const Instance& instance) {
            return scene.materials[scene.meshes[instance.mesh].material].unlit;
        });
    return !all_unlit && !effects.has(kEffectPunctualLights) && !effects.has(kEffectEnvironment) &&
           brightestEmission(scene) < kDimmestEmission;
}

}  // namespace licht
