#pragma once
// The scattering function once more, in double precision, by the textbook formulas with angles and as glTF
// has it, one reflection a microfacet: the naive reference of pure/bsdf.glsl. And what the tests of it share.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "licht/core/math.h"
#include "licht/shared/choices.h"
#include "licht/shared/constants.h"
#include "licht/shared/seam.h"

namespace licht::test {

using dvec3 = glm::dvec3;

/// As in pure/bsdf.glsl.
struct Material {
    vec3 diffuse{0.0F};
    float alpha = 1.0F;
    vec3 dielectric_f0{0.0F};
    float dielectric_f90 = 0.0F;
    vec3 metal_f0{0.0F};
    float metallic = 0.0F;

    [[nodiscard]] dvec3 f0() const {
        return glm::mix(dvec3(dielectric_f0), dvec3(metal_f0), static_cast<double>(metallic));
    }
    [[nodiscard]] double f90() const {
        return glm::mix(static_cast<double>(dielectric_f90), 1.0, static_cast<double>(metallic));
    }
    [[nodiscard]] double strongestDielectricF0() const {
        return static_cast<double>(std::max({dielectric_f0.x, dielectric_f0.y, dielectric_f0.z}));
    }
};

/// What the reference below says: specialisation constants.
inline std::map<std::uint32_t, std::uint32_t> asInTheTextbook() {
    return {{kConstantLayering, kLayeringGltf}, {kConstantEnergy, kEnergySingle}};
}

struct NamedMaterial {
    std::string name;
    Material material;
};

/// A specular layer that reflects everything.
inline Material mirror(float alpha) {
    return {vec3(0.0F), alpha, vec3(0.0F), 0.0F, vec3(1.0F), 1.0F};
}

inline Material metal(vec3 f0, float alpha) {
    return {vec3(0.0F), alpha, vec3(0.04F), 1.0F, f0, 1.0F};
}

inline Material plastic(vec3 albedo, float alpha, float f0, float f90) {
    return {albedo, alpha, vec3(f0), f90, vec3(0.0F), 0.0F};
}

inline std::vector<NamedMaterial> materials() {
    return {
        {"Lambert", {vec3(0.9F, 0.5F, 0.1F)}},
        {"smooth plastic", plastic(vec3(0.8F, 0.4F, 0.2F), 1e-3F, 0.04F, 1.0F)},
        {"plastic", plastic(vec3(0.8F, 0.4F, 0.2F), 0.1F, 0.04F, 1.0F)},
        {"rough plastic", plastic(vec3(0.8F, 0.4F, 0.2F), 1.0F, 0.04F, 1.0F)},
        {"plastic without specular", plastic(vec3(0.5F), 0.3F, 0.0F, 0.0F)},
        {"plastic with half a specular", plastic(vec3(0.5F), 0.3F, 0.02F, 0.5F)},
        {"half a metal", {vec3(0.4F, 0.2F, 0.1F), 0.3F, vec3(0.04F), 1.0F, vec3(0.8F, 0.4F, 0.2F), 0.5F}},
        {"polished gold", metal(vec3(1.0F, 0.78F, 0.34F), 1e-3F)},
        {"satin gold", metal(vec3(1.0F, 0.78F, 0.34F), 0.05F)},
        {"rough gold", metal(vec3(1.0F, 0.78F, 0.34F), 0.6F)},
        {"white", mirror(0.25F)},
        {"roughest white", mirror(1.0F)},
    };
}

/// Off the axes, so that x and y both matter.
inline vec3 outgoing(double cosine) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {sine * std::cos(0.7), sine * std::sin(0.7), cosine};
}

namespace reference {

inline double tan2(const dvec3& w) {
    return (w.x * w.x + w.y * w.y) / (w.z * w.z);
}

/// Walter et al. 2007, equation 33, by tangents.
inline double distribution(const dvec3& h, double alpha) {
    const double c4 = h.z * h.z * h.z * h.z;
    const double s = alpha * alpha + tan2(h);
    return alpha * alpha / (std::numbers::pi * c4 * s * s);
}

/// Heitz 2014, equation 72.
inline double lambda(const dvec3& w, double alpha) {
    return (std::sqrt(1.0 + alpha * alpha * tan2(w)) - 1.0) / 2.0;
}

inline double fresnel(double f0, double f90, double cosine) {
    return f0 + (f90 - f0) * std::pow(1.0 - cosine, 5.0);
}

/// glTF 2.0, Appendix B: what the half vector's microfacets do not reflect reaches the diffuse layer.
inline double passed(const Material& m, double cos_h) {
    return 1.0 - fresnel(m.strongestDielectricF0(), static_cast<double>(m.dielectric_f90), cos_h);
}

inline double f(const Material& m, int channel, const dvec3& wo, const dvec3& wi) {
    const dvec3 h = glm::normalize(wo + wi);
    const auto alpha = static_cast<double>(m.alpha);
    const double cosine = glm::dot(wo, h);
    const double specular = fresnel(m.f0()[channel], m.f90(), cosine) * distribution(h, alpha) /
                            (1.0 + lambda(wo, alpha) + lambda(wi, alpha)) / (4.0 * wo.z * wi.z);
    return static_cast<double>(m.diffuse[channel]) * passed(m, cosine) / std::numbers::pi + specular;
}

inline double specularShare(const Material& m, const dvec3& wo) {
    double specular = 0.0;
    double below = 0.0;
    for (int c = 0; c < 3; ++c) {
        specular = std::max(specular, fresnel(m.f0()[c], m.f90(), wo.z));
        below = std::max(below, static_cast<double>(m.diffuse[c]));
    }
    if (specular == 0.0) return 0.0;
    return below == 0.0 ? 1.0 : std::clamp(specular / (specular + below), 0.1, 0.9);
}

/// Density of visible normals, solid angle of h. Heitz 2014, equation 19.
inline double visibleNormals(double alpha, const dvec3& wo, const dvec3& h) {
    return std::max(glm::dot(wo, h), 0.0) * distribution(h, alpha) / (wo.z * (1.0 + lambda(wo, alpha)));
}

inline double pdf(const Material& m, const dvec3& wo, const dvec3& wi) {
    const double share = specularShare(m, wo);
    const dvec3 h = glm::normalize(wo + wi);
    const double specular =
        share > 0.0 ? visibleNormals(static_cast<double>(m.alpha), wo, h) / (4.0 * glm::dot(wo, h)) : 0.0;
    return share * specular + (1.0 - share) * wi.z / std::numbers::pi;
}

}  // namespace reference

/// Normals as angles that fit the lobe: tan(theta) = alpha tan(psi), so that every alpha looks alike.
struct NormalCell {
    dvec3 h;
    double solid_angle;  ///< per unit of psi and phi
};

inline NormalCell normalAt(double alpha, double psi, double phi) {
    const double t = alpha * std::tan(psi);
    const double c = 1.0 / std::sqrt(1.0 + t * t);
    return {{c * t * std::cos(phi), c * t * std::sin(phi), c},
            c * c * c * t * alpha / (std::cos(psi) * std::cos(psi))};
}

}  // namespace licht::test
