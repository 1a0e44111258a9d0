#include "licht/light/light_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "licht/colour/transfer.h"
#include "licht/core/error.h"
#include "licht/light/alias_table.h"
#include "licht/light/light_tree.h"
#include "licht/scene/emitter_shapes.h"
#include "licht/shared/effects.h"
#include "licht/shared/light_views.h"

namespace licht {
namespace {

vec3 mean(const Texture& texture) {
    glm::dvec3 sum(0.0);
    const std::size_t stride = texture.bits / 8;
    const std::size_t texels = std::size_t{texture.width} * texture.height;
    for (std::size_t i = 0; i < texels; ++i) {
        vec3 c;
        for (int k = 0; k < 3; ++k) {
            const std::uint8_t* at = &texture.bytes[(4 * i + static_cast<std::size_t>(k)) * stride];
            c[k] = linearFromSrgb(stride == 1 ? static_cast<float>(at[0]) / 255.0F
                                              : static_cast<float>(at[0] | at[1] << 8) / 65535.0F);
        }
        sum += glm::dvec3(c);
    }
    return texels > 0 ? vec3(sum / static_cast<double>(texels)) : vec3(0.0F);
}

// How much a light's colour counts: all channels alike, for errors are looked at in each of them. By
// luminance a blue lamp would seldom be asked, and its picture's blue would be noise.
double strength(const vec3& colour) {
    const glm::dvec3 c(colour);
    return (c.x + c.y + c.z) / 3.0;
}

// What a material emits, one number for all its triangles.
std::vector<double> emittedStrength(const Scene& scene) {
    std::vector<double> result;
    for (const Material& m : scene.materials) {
        vec3 value = m.unlit ? vec3(0.0F) : m.emission;
        if (strength(value) > 0.0 && m.slots[kSlotEmissive].present())
            value *= mean(scene.textures[m.slots[kSlotEmissive].texture]);
        result.push_back((m.double_sided ? 2.0 : 1.0) * strength(value));
    }
    return result;
}

void addShape(LightTable& table, std::vector<double>& weights, LightRecord light, double strength_of_area) {
    const ShapeLight shape = unpackShape(light);
    const double area = static_cast<double>(glm::length(glm::cross(shape.edge_u, shape.edge_v)));
    table.lights.push_back(light);
    weights.push_back(std::isfinite(area) ? area * strength_of_area : 0.0);
}

// A hit on any face finds the same light; nothing picks it a second time. Of what double-sided ones send
// inwards nothing gets out.
void addSphere(LightTable& table, std::vector<double>& weights, LightRecord light, const Ball& ball,
               const vec3& emission, std::size_t faces) {
    light.kind = kLightSphere;
    light = packSphere(light, {ball.centre, ball.radius, emission});
    const double weight = ball.area * strength(emission);
    for (std::size_t k = 0; k < faces; ++k) {
        table.lights.push_back(light);
        weights.push_back(k == 0 && std::isfinite(weight) ? weight : 0.0);
    }
}

// Before any record is made. One more is the sky.
void requireCountable(const Scene& scene, const std::vector<double>& strengths) {
    std::uint64_t lights = scene.lights.size() + 1;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (strengths[mesh.material] > 0.0) lights += mesh.triangles.size();
    }
    if (lights > kMostLights)
        throw InputError(fmt::format(
            "the scene has {} lights, counting each triangle that shines, and at most {} can be picked from",
            lights, kMostLights));
}

void addShapes(const Scene& scene, bool spheres, LightTable& table, std::vector<double>& weights) {
    const std::vector<double> strengths = emittedStrength(scene);
    requireCountable(scene, strengths);
    for (uint i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Material& material = scene.materials[mesh.material];
        if (strengths[mesh.material] <= 0.0) continue;
        table.first_light[i] = static_cast<uint>(table.lights.size());
        LightRecord light{};
        light.instance = i;
        if (const std::optional<Ball> ball = spheres ? roundEmitter(scene, instance) : std::nullopt) {
            addSphere(table, weights, light, *ball, material.emission, mesh.triangles.size());
            continue;
        }
        const uint flags =
            (material.double_sided ? kLightDoubleSided : 0U) | (material.emitsEvenly() ? 0U : kLightUneven);
        for (uint k = 0; k < mesh.triangles.size(); ++k) {
            const Corners p = worldCorners(mesh, instance.world_from_object, k);
            light.primitive = k;
            if (k + 1 < mesh.triangles.size() && material.emitsEvenly()) {
                if (const std::optional<Rectangle> r =
                        rectangleOf(p, worldCorners(mesh, instance.world_from_object, k + 1))) {
                    light.kind = kLightRectangle | flags;
                    light = packShape(light, {r->corner, r->first_edge, r->second_edge, material.emission});
                    addShape(table, weights, light, strengths[mesh.material]);
                    // A hit on the second half finds the same light; nothing picks it a second time.
                    addShape(table, weights, light, 0.0);
                    ++k;
                    continue;
                }
            }
            light.kind = kLightTriangle | flags;
            light = packShape(light, {p[0], p[1] - p[0], p[2] - p[0], material.emission});
            addShape(table, weights, light, 0.5 * strengths[mesh.material]);
        }
    }
}

// What stands beside the first half of a rectangle, or the first face of a sphere, is the same light.
void copyToOtherParts(LightTable& table) {
    for (std::size_t i = 1; i < table.lights.size(); ++i) {
        const LightRecord& first = table.lights[i - 1];
        LightRecord& second = table.lights[i];
        if (isShape(second) && second.kind == first.kind && second.instance == first.instance &&
            second.primitive == first.primitive)
            second = first;
    }
}

// `weight`: area times strength of what emits.
LightBound boundOfSphere(const SphereLight& light, double weight) {
    LightBound bound;
    bound.low = glm::dvec3(light.centre) - static_cast<double>(light.radius);
    bound.high = glm::dvec3(light.centre) + static_cast<double>(light.radius);
    bound.axis = glm::dvec3(0, 0, 1);
    bound.normals_angle = std::numbers::pi;
    bound.emission_angle = 0.5 * std::numbers::pi;
    bound.intensity = weight;
    return bound;
}

LightBound boundOfShape(const ShapeLight& light, bool rectangle, bool two_sided, double weight) {
    LightBound bound;
    const glm::dvec3 at(light.corner);
    const glm::dvec3 e1(light.edge_u);
    const glm::dvec3 e2(light.edge_v);
    bound.low = glm::min(at, glm::min(at + e1, at + e2));
    bound.high = glm::max(at, glm::max(at + e1, at + e2));
    if (rectangle) {
        bound.low = glm::min(bound.low, at + e1 + e2);
        bound.high = glm::max(bound.high, at + e1 + e2);
    }
    bound.axis = glm::normalize(glm::cross(e1, e2));
    bound.emission_angle = 0.5 * std::numbers::pi;
    bound.two_sided = two_sided;
    bound.intensity = two_sided ? 0.5 * weight : weight;
    return bound;
}

LightBound boundOfSpot(const SpotLight& light, bool spot) {
    LightBound bound;
    bound.low = bound.high = glm::dvec3(light.position);
    bound.intensity = strength(light.intensity);
    bound.axis = glm::dvec3(light.axis);
    if (!spot) {
        bound.intensity *= 4.0;  // a sphere has four times the area that it shows
        bound.axis = glm::dvec3(0, 0, 1);
        bound.normals_angle = std::numbers::pi;
        bound.emission_angle = 0.5 * std::numbers::pi;
    } else {
        // The cone ends where 1 - cos = offset / scale.
        const double versine = static_cast<double>(light.offset) / static_cast<double>(light.scale);
        bound.emission_angle = 2.0 * std::asin(std::sqrt(std::clamp(0.5 * versine, 0.0, 1.0)));
    }
    return bound;
}

LightBound boundOf(const LightRecord& light, double weight) {
    const uint kind = kindOf(light);
    if (kind == kLightSphere) return boundOfSphere(unpackSphere(light), weight);
    if (isShape(light))
        return boundOfShape(unpackShape(light), kind == kLightRectangle,
                            (light.kind & kLightDoubleSided) != 0, weight);
    return boundOfSpot(unpackSpot(light), kind == kLightSpot);
}

// Gives the lights that are somewhere their trails; true where there are enough of them for a tree.
bool growTree(LightTable& table, std::span<const double> weights) {
    std::vector<LightBound> bounds;
    std::vector<uint> indices;
    for (uint i = 0; i < weights.size(); ++i) {
        if (!(weights[i] > 0.0)) continue;
        bounds.push_back(boundOf(table.lights[i], weights[i]));
        indices.push_back(i);
    }
    if (bounds.size() < 2) return false;
    LightTree tree = buildLightTree(bounds);
    for (LightChildRecord& child : tree.children)
        if ((child.next & kLightLeaf) != 0)
            child.next = (child.next & ~kLightIndexMask) | indices[child.next & kLightIndexMask];
    for (std::size_t i = 0; i < indices.size(); ++i) table.lights[indices[i]].trail = tree.trails[i];
    table.tree = std::move(tree.children);
    table.tree_lights = static_cast<uint>(weights.size());
    return true;
}

LightRecord sunRecord(const PunctualLight& light) {
    LightRecord record{};
    record.kind = kLightDirectional;
    const float sine = fillsAngle(light) ? std::sin(0.5F * light.angular_diameter) : 0.0F;
    return packSun(record, {light.direction, light.intensity, sine * sine});
}

LightRecord spotRecord(const PunctualLight& light) {
    LightRecord record{};
    const bool spot = light.kind == PunctualLight::Kind::spot;
    record.kind = spot ? kLightSpot : kLightPoint;
    // KHR_lights_punctual's reference falloff, (cos - cos outer) / (cos inner - cos outer), whatever the
    // width. An edge without width is as wide as rounding: 1e-6 of 1 - cos outer.
    const auto versine = [](float angle) {
        const double s = std::sin(0.5 * static_cast<double>(angle));
        return 2.0 * s * s;
    };
    const double outer = versine(light.outer_cone);
    const double width = std::max({outer - versine(light.inner_cone), 1e-6 * outer, 1e-30});
    const auto scale = spot ? static_cast<float>(1.0 / width) : 0.0F;
    const auto offset = spot ? static_cast<float>(outer / width) : 0.0F;
    return packSpot(record, {light.position, light.range, light.intensity, light.direction, scale, offset});
}

// No length of its own, so that a scene's scale changes no pick. Where there is nothing to light any will do.
double fluxRadius(const Scene& scene) {
    const auto radius = static_cast<double>(sceneBounds(scene).radius());
    return radius > 0.0 ? radius : 1.0;
}

// Flux; a directional light's is what passes through the scene's bounding sphere.
double flux(const PunctualLight& light, double radius) {
    const double intensity = strength(light.intensity);
    switch (light.kind) {
        case PunctualLight::Kind::point:
            return 4.0 * std::numbers::pi * intensity;
        case PunctualLight::Kind::spot: {
            const double s = std::sin(0.5 * static_cast<double>(light.outer_cone));
            return 4.0 * std::numbers::pi * s * s * intensity;
        }
        case PunctualLight::Kind::directional:
            return std::numbers::pi * radius * radius * intensity;
    }
    return 0.0;
}

}  // namespace

bool isShape(const LightRecord& light) {
    const uint kind = kindOf(light);
    return kind == kLightTriangle || kind == kLightRectangle || kind == kLightSphere;
}

LightTable buildLightTable(const Scene& scene, const Effects& effects, const Pickable& pickable,
                           LightChoice choice) {
    LightTable table;
    table.first_light.assign(scene.instances.size(), kNoIndex);
    std::vector<double> weights;
    std::vector<std::size_t> kind_ends{0};
    const auto endKind = [&] { kind_ends.push_back(weights.size()); };

    if (effects.has(kEffectLightTriangles) && pickable.surfaces_and_suns)
        addShapes(scene, effects.has(kEffectLightSpheres), table, weights);
    const std::size_t shapes = weights.size();
    const bool punctual = effects.has(kEffectPunctualLights);
    const double radius = fluxRadius(scene);
    const auto addPunctual = [&](bool directional, bool disc) {
        for (const PunctualLight& light : scene.lights) {
            if (!punctual || (light.kind == PunctualLight::Kind::directional) != directional ||
                fillsAngle(light) != disc)
                continue;
            table.lights.push_back(directional ? sunRecord(light) : spotRecord(light));
            weights.push_back(disc && !pickable.surfaces_and_suns ? 0.0 : flux(light, radius));
        }
    };
    addPunctual(false, false);
    if (choice == LightChoice::tree && growTree(table, weights)) {
        endKind();
    } else {
        kind_ends.push_back(shapes);
    }
    addPunctual(true, false);
    table.first_sun = static_cast<uint>(table.lights.size());
    addPunctual(true, true);
    table.suns = static_cast<uint>(table.lights.size()) - table.first_sun;
    endKind();
    if (effects.has(kEffectEnvironment) && pickable.sky && scene.environment) {
        table.environment_light = static_cast<uint>(table.lights.size());
        LightRecord light{};
        light.kind = kLightEnvironment;
        table.lights.push_back(light);
        weights.push_back(1.0);
    }
    endKind();

    if (choice == LightChoice::uniform)
        for (double& w : weights) w = w > 0.0 ? 1.0 : 0.0;
    for (std::size_t k = 0; k + 1 < kind_ends.size(); ++k) {
        const auto first = weights.begin() + static_cast<std::ptrdiff_t>(kind_ends[k]);
        const auto last = weights.begin() + static_cast<std::ptrdiff_t>(kind_ends[k + 1]);
        const double sum = std::accumulate(first, last, 0.0);
        if (sum > 0.0) std::for_each(first, last, [sum](double& w) { w /= sum; });
    }
    // A tree is one column, whose weight is that of a kind.
    std::vector<double> columns;
    if (table.tree_lights > 0) columns.push_back(1.0);
    for (std::size_t i = table.tree_lights; i < weights.size(); ++i) columns.push_back(weights[i]);
    table.alias = buildAliasTable(columns);
    if (table.alias.empty()) {
        LightTable none;
        none.first_light.assign(scene.instances.size(), kNoIndex);
        const auto first = table.lights.begin() + table.first_sun;
        none.lights.assign(first, first + table.suns);
        none.suns = table.suns;
        return none;
    }
    for (std::size_t i = 0; i < table.lights.size(); ++i) {
        const bool in_tree = i < table.tree_lights;
        const std::size_t column = table.tree_lights == 0 ? i : in_tree ? 0 : i - table.tree_lights + 1;
        table.lights[i].pmf = in_tree && !(weights[i] > 0.0) ? 0.0F : table.alias[column].pmf;
    }
    copyToOtherParts(table);
    return table;
}

}  // namespace licht
