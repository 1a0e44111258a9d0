// Reflection by microfacets of the isotropic GGX distribution, each of reflectance one.
// Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; Heitz 2014, Understanding the Masking-Shadowing Function.
#ifndef LICHT_PURE_LOBE_GGX_GLSL
#define LICHT_PURE_LOBE_GGX_GLSL

#include "pure/sampling.glsl"

// Below this the lobe is narrower than fp32 can sample with a meaningful density (D grows as 1 / (pi alpha^2)).
const float kMinAlpha = 1e-3;

float alphaOf(float roughness) { return max(roughness * roughness, kMinAlpha); }

// Biased: a narrow lobe behind another scattering makes rare bright paths, a wider one blurs what only they would show. The widths are those of pbrt-v4
// (Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 14.2.3, path regularization).
float regularisedAlpha(float alpha) { return alpha < 0.3 ? clamp(2.0 * alpha, 0.1, 0.3) : alpha; }

// Normal distribution, 1/sr. sin^2 comes from the components, not from 1 - cos^2, which cancels for smooth surfaces.
float ggxD(vec3 h, float alpha) {
    float a2 = alpha * alpha;
    float d = a2 * h.z * h.z + dot(h.xy, h.xy);
    return h.z > 0.0 ? a2 / (kPi * d * d) : 0.0;
}

// Smith's Lambda for a direction with cos = w.z > 0.
float ggxLambda(vec3 w, float alpha) {
    float tan2 = dot(w.xy, w.xy) / (w.z * w.z);
    return 0.5 * (sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

float ggxG1(vec3 w, float alpha) { return 1.0 / (1.0 + ggxLambda(w, alpha)); }

// Height-correlated masking and shadowing.
float ggxG2(vec3 wo, vec3 wi, float alpha) { return 1.0 / (1.0 + ggxLambda(wo, alpha) + ggxLambda(wi, alpha)); }

struct GgxValue {
    float f;    // 1/sr, to be multiplied by the cosine that was given
    float pdf;  // of wi given wo, solid angle: D_visible / (4 wo.h)
};

// h: the half vector. cos_i: what f is multiplied by, wi.z unless the microfacets lie in a frame of their own.
GgxValue evaluateGgx(float alpha, vec3 wo, vec3 wi, vec3 h, float cos_i) {
    float d = ggxD(h, alpha);
    return GgxValue(d * ggxG2(wo, wi, alpha) / (4.0 * wo.z * cos_i), ggxG1(wo, alpha) * d / (4.0 * wo.z));
}

// A half vector from the distribution of visible normals. Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps.
vec3 sampleGgxVisibleNormal(vec3 wo, float alpha, vec2 u) {
    vec3 stretched = normalize(vec3(alpha * wo.xy, wo.z));
    float z = (1.0 - u.x) * (1.0 + stretched.z) - stretched.z;
    vec3 cap = vec3(sqrt(clamp(1.0 - z * z, 0.0, 1.0)) * unitCircle(u.y), z);
    vec3 h = cap + stretched;
    h = vec3(alpha * h.xy, max(h.z, 0.0));
    float length2 = dot(h, h);
    // wo grazing and the cap's opposite pole: the sum vanishes, any visible normal will do.
    return length2 > 0.0 ? h * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
}

// May point below the surface, where nothing is reflected.
vec3 sampleGgx(float alpha, vec3 wo, vec2 u) {
    vec3 h = sampleGgxVisibleNormal(wo, alpha, u);
    return 2.0 * dot(wo, h) * h - wo;
}

#endif
