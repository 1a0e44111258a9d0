// The Fresnel reflectance of what lies under a thin film, in the form of KHR_materials_iridescence. No polarisation.
// Belcour and Barla 2017, A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence.
#ifndef LICHT_PURE_LOBE_THIN_FILM_GLSL
#define LICHT_PURE_LOBE_THIN_FILM_GLSL

#include "pure/lobe/fresnel.glsl"
#include "pure/sampling.glsl"

struct ThinFilm {
    float strength;   // share of the reflectance that the film rules; 0: no film
    float ior;        // at least 1, that of the air above
    float thickness;  // nm
};

// A film without thickness is none: the formulas below keep its two interfaces however near they are.
ThinFilm thinFilm(float strength, float ior, float thickness) { return ThinFilm(thickness > 0.0 ? strength : 0.0, ior, thickness); }

// The CIE 1931 colour matching functions as Gaussians over the wave number; X has two, the second one stands in w. The published numbers
// are per metre and radian; here the weights have their integral divided out, and path differences come in nm.
const float kNanometre = 1e-9;
const vec4 kGaussianHeight = vec4(5.4856e-13, 4.4201e-13, 5.2481e-13, 9.7470e-14) / 1.0685e-7;
const vec4 kGaussianVariance = vec4(4.3278e9, 9.3046e9, 6.6121e9, 4.5282e9);
const vec4 kGaussianWeight = kGaussianHeight * sqrt(2.0 * kPi * kGaussianVariance);
const vec4 kTurnsPerNanometre = vec4(1.6810e6, 1.7953e6, 2.2084e6, 2.2399e6) * kNanometre;
const vec4 kDampingPerNanometre2 = (2.0 * kPi * kNanometre) * kGaussianVariance * (2.0 * kPi * kNanometre);

// XYZ to linear Rec. 709, white point D65 (IEC 61966-2-1); column by column.
const mat3 kRec709FromXyz = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560, 1.0572252);

// Reflectance between two dielectrics at normal incidence.
vec3 normalReflectance(vec3 ior_below, float ior_above) {
    vec3 r = (ior_below - ior_above) / (ior_below + ior_above);
    return r * r;
}

// What one angle makes of a film, whatever lies under it.
struct ThinFilmResponse {
    float r12;         // reflectance from air to film
    float cos_inside;  // the angle inside the film
    mat2x3 xyz;        // what the eye keeps of the first and second order of interference
};

// cos_theta: between a direction and the half vector.
ThinFilmResponse thinFilmResponse(ThinFilm thin_film, float cos_theta) {
    // Snell's law. Coming from air, nothing is reflected totally.
    float sin2 = (1.0 - cos_theta * cos_theta) / (thin_film.ior * thin_film.ior);
    float cos_inside = sqrt(max(1.0 - sin2, 0.0));
    float path_difference = 2.0 * thin_film.ior * thin_film.thickness * cos_inside;

    vec4 turns = fract(path_difference * kTurnsPerNanometre);
    vec4 cosine = vec4(unitCircle(turns.x).x, unitCircle(turns.y).x, unitCircle(turns.z).x, unitCircle(turns.w).x);
    vec4 decay = exp(-path_difference * path_difference * kDampingPerNanometre2);
    // The second order goes twice as far: cos 2x from cos x, and the square of the distance is four times as large.
    vec4 first = kGaussianWeight * decay * cosine;
    vec4 second = kGaussianWeight * (decay * decay * decay * decay) * (2.0 * cosine * cosine - 1.0);
    return ThinFilmResponse(fresnelSchlick(normalReflectance(vec3(thin_film.ior), 1.0), 1.0, cos_theta).x, cos_inside,
                            mat2x3(first.x + first.w, first.y, first.z, second.x + second.w, second.y, second.z));
}

// Reflectance of thin film and base together, in [0,1]. base_f0: of the base alone against air.
vec3 fresnelThinFilm(ThinFilm thin_film, ThinFilmResponse response, vec3 base_f0) {
    const float kLargestF0 = 0.9999;  // a base that reflects all has no finite index
    vec3 root = sqrt(clamp(base_f0, 0.0, kLargestF0));
    vec3 base_ior = (1.0 + root) / (1.0 - root);
    vec3 r23 = fresnelSchlick(normalReflectance(base_ior, thin_film.ior), 1.0, response.cos_inside);

    // Airy's series: its constant term and the first two orders of interference.
    float t121 = 1.0 - response.r12;
    vec3 r123 = clamp(response.r12 * r23, 1e-5, 0.9999);  // the bounds of the extension: a root and a series that stay finite
    vec3 within = t121 * t121 * r23 / (1.0 - r123);
    vec3 root123 = sqrt(r123);
    vec3 amplitude = 2.0 * (within - t121) * root123;
    // Half a turn between what the air's side of the film reflects and what the film keeps, and another where the base is the lighter medium:
    // the first order changes its sign with the base.
    vec3 turned = mix(vec3(-1.0), vec3(1.0), lessThan(base_ior, vec3(thin_film.ior)));
    vec3 reflectance = response.r12 + within + amplitude * (kRec709FromXyz * (turned * response.xyz[0])) +
                       amplitude * root123 * (kRec709FromXyz * response.xyz[1]);
    return clamp(reflectance, 0.0, 1.0);
}

#endif
