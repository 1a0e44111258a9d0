// From linear scene light to linear display light in [0,1]. Every curve takes any finite non-negative input.
#ifndef LICHT_PURE_TONEMAP_GLSL
#define LICHT_PURE_TONEMAP_GLSL

// Khronos PBR Neutral Tone Mapper (Khronos Group 2024, specification): keeps base colours below 0.8 as they are.
vec3 tonemapNeutral(vec3 c) {
    const float kStart = 0.8 - 0.04;
    const float kDesaturation = 0.15;
    float x = min(c.r, min(c.g, c.b));
    c -= x < 0.08 ? x - 6.25 * x * x : 0.04;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < kStart) return c;
    float d = 1.0 - kStart;
    float new_peak = 1.0 - d * d / (peak + d - kStart);
    c *= new_peak / peak;
    float g = 1.0 - 1.0 / (kDesaturation * (peak - new_peak) + 1.0);
    return mix(c, vec3(new_peak), g);
}

// AgX (Sobotka 2022), its base look in the polynomial fit of Wrensch 2023.
vec3 tonemapAgx(vec3 c) {
    const mat3 kInset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992, 0.878468636469772, 0.0784336,
                             0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 kOutset = mat3(1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368, 1.15190312990417,
                              -0.0980434501171241, -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    const float kMinEv = -12.47393, kMaxEv = 4.026069;
    c = max(kInset * c, vec3(1e-10));  // log2 of zero
    vec3 x = (clamp(log2(c), kMinEv, kMaxEv) - kMinEv) / (kMaxEv - kMinEv);
    vec3 x2 = x * x, x4 = x2 * x2;
    vec3 y = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
    return pow(max(kOutset * y, vec3(0.0)), vec3(2.2));
}

// ACES reference rendering and output transform for Rec. 709 displays, fit of Hill 2016.
vec3 tonemapAces(vec3 c) {
    const mat3 kInput = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 kOutput = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = kInput * min(c, vec3(1e15));  // squared below
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return kOutput * v;
}

#endif
