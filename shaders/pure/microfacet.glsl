// The isotropic GGX microfacet distribution in the local frame (+Z = normal).
// Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; Heitz 2014, Understanding the Masking-Shadowing Function.
#ifndef LICHT_PURE_MICROFACET_GLSL
#define LICHT_PURE_MICROFACET_GLSL

#include "pure/sampling.glsl"

// Below this the lobe is narrower than fp32 can sample with a meaningful density (D grows as 1 / (pi alpha^2)).
const float kMinAlpha = 1e-3;

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

// Density of the reflected direction, solid angle: D_visible / (4 wo.h).
float pdfGgxReflection(vec3 wo, vec3 h, float alpha) { return ggxG1(wo, alpha) * ggxD(h, alpha) / (4.0 * wo.z); }

// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering.
vec3 fresnelSchlick(vec3 f0, float f90, float cos_theta) {
    float m = clamp(1.0 - cos_theta, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}

#endif
