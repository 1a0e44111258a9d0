// What is mirrored, as if it were seen behind the mirror.
#ifndef LICHT_PURE_MIRROR_GLSL
#define LICHT_PURE_MIRROR_GLSL

// Where behind a mirror the image of what lies so far before it is. curvature: of the mirror, 1/m, positive where it is convex (Coddington's equation, of its
// mean). Negative: before the mirror.
float distanceOfImage(float distance_, float curvature, float cos_o) { return distance_ / (1.0 + 2.0 * curvature * distance_ / max(cos_o, 0.1)); }

// How far a lobe of that GGX width looks along the mirror's direction: 1 a mirror, 0 any way.
// Lagarde, de Rousiers 2014, Moving Frostbite to Physically Based Rendering, section 4.9.3.
float mirrorLikeness(float alpha) {
    float roughness = sqrt(clamp(alpha, 0.0, 1.0)), smoothness = 1.0 - roughness;
    return smoothness * (sqrt(smoothness) + roughness);
}

#endif
