#include "licht/render/light_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "licht/colour/transfer.h"
#include "licht/render/alias_table.h"

namespace licht {
namespace {

double mean(const Texture& texture) {
    double sum = 0.0;
    const std::size_t stride = texture.bits / 8;
    const std::size_t texels = std::size_t{texture.width} * texture.height;
    for (std::size_t i = 0; i < texels; ++i) {
        vec3 c;
        for (int k = 0; k < 3; ++k) {
            const std::uint8_t* at = &texture.bytes[(4 * i + static_cast<std::size_t>(k)) * stride];
            c[k] = linearFromSrgb(stride == 1 ? static_cast<float>(at[0]) / 255.0F
                                              : static_cast<float>(at[0] | at[1] << 8) / 65535.0F);
        }
        sum += static_cast<double>(luminance(c));
    }
    return texels > 0 ? sum / static_cast<double>(texels) : 0.0;
}

// Luminous exitance over pi of each material, one number for all its triangles.
std::vector<double> emittedLuminance(const Scene& scene) {
    std::vector<double> result;
    for (const Material& m : scene.materials) {
        double value = m.unlit ? 0.0 : static_cast<double>(luminance(m.emission));
        if (value > 0.0 && m.emissive_texture.present())
            value *= mean(scene.textures[m.emissive_texture.texture]);
        result.push_back(m.double_sided ? 2.0 * value : value);
    }
    return result;
}

void addTriangles(const Scene& scene, LightTable& table, std::vector<double>& weights) {
    const std::vector<double> luminances = emittedLuminance(scene);
    for (uint i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (luminances[mesh.material] <= 0.0) continue;
        table.first_light[i] = static_cast<uint>(table.lights.size());
        for (uint k = 0; k < mesh.triangles.size(); ++k) {
            glm::dvec3 p[3];
            for (int c = 0; c < 3; ++c)
                p[c] = glm::dvec3(
                    vec3(instance.world_from_object * vec4(mesh.positions[mesh.triangles[k][c]], 1.0F)));
            LightRecord light{};
            light.kind = kLightTriangle;
            light.instance = i;
            light.primitive = k;
            table.lights.push_back(light);
            weights.push_back(0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) *
                              luminances[mesh.material]);
        }
    }
}

LightRecord punctualRecord(const PunctualLight& light) {
    LightRecord record{};
    record.position = light.position;
    record.direction = light.direction;
    record.intensity = light.intensity;
    record.range = light.range;
    record.kind = light.kind == PunctualLight::Kind::point  ? kLightPoint
                  : light.kind == PunctualLight::Kind::spot ? kLightSpot
                                                            : kLightDirectional;
    if (light.kind == PunctualLight::Kind::spot) {
        // KHR_lights_punctual's reference falloff; the smallest width protects the division where both cones
        // are equal.
        const float outer = std::cos(light.outer_cone);
        record.cone_scale = 1.0F / std::max(0.001F, std::cos(light.inner_cone) - outer);
        record.cone_offset = -outer * record.cone_scale;
    }
    return record;
}

// Luminous flux, lumen; a directional light's is what passes through the scene's bounding sphere.
double flux(const PunctualLight& light, double radius) {
    const auto intensity = static_cast<double>(luminance(light.intensity));
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

LightTable buildLightTable(const Scene& scene, const Effects& effects, bool sample_surfaces_and_sky) {
    LightTable table;
    table.first_light.assign(scene.instances.size(), kNoIndex);
    std::vector<double> weights;
    std::vector<std::size_t> kind_ends{0};
    const auto endKind = [&] { kind_ends.push_back(weights.size()); };

    if (effects.has(kEffectLightTriangles) && sample_surfaces_and_sky) addTriangles(scene, table, weights);
    endKind();
    if (effects.has(kEffectPunctualLights)) {
        const double radius = std::max(static_cast<double>(sceneBounds(scene).radius()), 1.0);
        for (const PunctualLight& light : scene.lights) {
            table.lights.push_back(punctualRecord(light));
            weights.push_back(flux(light, radius));
        }
    }
    endKind();
    if (effects.has(kEffectEnvironment) && sample_surfaces_and_sky && scene.environment) {
        table.environment_light = static_cast<uint>(table.lights.size());
        LightRecord light{};
        light.kind = kLightEnvironment;
        table.lights.push_back(light);
        weights.push_back(1.0);
    }
    endKind();

    for (std::size_t k = 0; k + 1 < kind_ends.size(); ++k) {
        const auto first = weights.begin() + static_cast<std::ptrdiff_t>(kind_ends[k]);
        const auto last = weights.begin() + static_cast<std::ptrdiff_t>(kind_ends[k + 1]);
        const double sum = std::accumulate(first, last, 0.0);
        if (sum > 0.0) std::for_each(first, last, [sum](double& w) { w /= sum; });
    }
    table.alias = buildAliasTable(weights);
    if (table.alias.empty())
        return LightTable{{}, {}, std::vector<uint>(scene.instances.size(), kNoIndex), kNoIndex};
    for (std::size_t i = 0; i < table.lights.size(); ++i) table.lights[i].pmf = table.alias[i].pmf;
    return table;
}

std::vector<AliasRecord> buildEnvironmentTable(const Environment& environment) {
    const Image& map = environment.radiance;
    const auto texel = [&map](int x, int y) {
        const int wrapped = (x + map.width) % map.width;
        const int clamped = std::clamp(y, 0, map.height - 1);
        return static_cast<double>(luminance(
            vec3(map.at(wrapped, clamped, 0), map.at(wrapped, clamped, 1), map.at(wrapped, clamped, 2))));
    };
    std::vector<double> weights;
    weights.reserve(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    for (int y = 0; y < map.height; ++y) {
        const double upper = std::cos(std::numbers::pi * y / map.height);
        const double lower = std::cos(std::numbers::pi * (y + 1) / map.height);
        for (int x = 0; x < map.width; ++x) {
            // The integral of the bilinear interpolant over its texel: 1/8, 6/8, 1/8 along each axis.
            double sum = 0.0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    sum += texel(x + i, y + j) * (i == 0 ? 6.0 : 1.0) * (j == 0 ? 6.0 : 1.0) / 64.0;
            weights.push_back(sum * (upper - lower));
        }
    }
    return buildAliasTable(weights);
}

}  // namespace licht
