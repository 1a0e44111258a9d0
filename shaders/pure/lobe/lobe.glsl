// What every lobe is: in a local frame, +Z its normal, wo and wi unit and away from the surface. The verbs of a lobe X with its parameters in a struct:
//   evaluateX   what it makes of a pair of directions, f and pdf together, because they share most of their work
//   sampleX     a direction for a wo
//   albedoX     about what share of the light it sends to a wo: for picking among lobes
//   passX       what a layer leaves to what lies under it, of light that comes from wi and goes to wo
#ifndef LICHT_PURE_LOBE_LOBE_GLSL
#define LICHT_PURE_LOBE_LOBE_GLSL

struct LobeValue {
    vec3 f;     // 1/sr, without the cosine
    float pdf;  // of wi given wo, solid angle
};

const LobeValue kNothing = LobeValue(vec3(0.0), 0.0);

// A layer over what lies below. share: of the samples that are spent on the layer.
LobeValue over(LobeValue layer, LobeValue below, float share) { return LobeValue(layer.f + below.f, mix(below.pdf, layer.pdf, share)); }

// What lies below, of whose light a layer passes that share.
LobeValue under(float passed, LobeValue below) { return LobeValue(passed * below.f, below.pdf); }

// Share of the samples of a lobe by what it sends towards wo against another one. No lobe is starved, for that is an estimate for wo alone: weights stay
// below ten times a lobe's own.
float shareOfLobe(float its, float others) {
    const float kLeastShare = 0.1;
    return clamp(its / (its + others), kLeastShare, 1.0 - kLeastShare);
}

// What a number that decided between lobes has not yet decided is uniform again.
float rescaledBelow(float u, float share) { return (u - share) / (1.0 - share); }

// Whether light can be reflected from the one to the other: both are above the surface.
bool sameSide(vec3 wo, vec3 wi) { return wo.z > 0.0 && wi.z > 0.0; }

float largest(vec3 c) { return max(c.x, max(c.y, c.z)); }

#endif
