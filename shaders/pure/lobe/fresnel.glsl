// Reflectance of a smooth interface by angle.
#ifndef LICHT_PURE_LOBE_FRESNEL_GLSL
#define LICHT_PURE_LOBE_FRESNEL_GLSL

// Schlick 1994, An Inexpensive BRDF Model for Physically-based Rendering.
vec3 fresnelSchlick(vec3 f0, float f90, float cos_theta) {
    float m = clamp(1.0 - cos_theta, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}

// Its mean over the hemisphere, by cosine: the integral of 2 c (1 - c)^5 is 1/21.
vec3 meanFresnelSchlick(vec3 f0, float f90) { return mix(f0, vec3(f90), 1.0 / 21.0); }

#endif
