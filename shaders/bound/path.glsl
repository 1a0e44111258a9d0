// The estimator: L = sum over i of T^i Le along one random path.
// Kajiya 1986, The Rendering Equation; Veach 1997, Robust Monte Carlo Methods for Light Transport Simulation.
#ifndef LICHT_BOUND_PATH_GLSL
#define LICHT_BOUND_PATH_GLSL

#include "bound/light.glsl"

layout(constant_id = 32) const bool kDirectMis = true;  // kConstantDirectMis: combine next event estimation with scattering

struct PathCounts {
    uint bounce_rays;
    uint shadow_rays;
};

// Light that arrives straight from a sampled light and scatters towards wo: one order of T applied to Le.
vec3 directLight(Surface s, vec3 wo_local, uint dimension, inout PathCounts counts) {
    LightSample light = sampleLight(s, g_address, dimension);
    if (!light.valid) return vec3(0.0);
    vec3 wi = normalize(light.direction);
    if (dot(wi, s.face_normal) <= 0.0) return vec3(0.0);
    vec3 wi_local = localFromWorld(s.frame, wi);
    vec3 f = bsdfEvaluate(s.bsdf, wo_local, wi_local);
    if (largest(f) <= 0.0) return vec3(0.0);
    ++counts.shadow_rays;
    if (occluded(offsetOrigin(s, wi), light.direction, light.t_max)) return vec3(0.0);
    float weight = light.delta ? 1.0 : misWeight(light.pdf, bsdfPdf(s.bsdf, wo_local, wi_local));
    return f * light.radiance * (wi_local.z * weight / light.pdf);
}

vec3 skyRadiance(vec3 direction) { return kEnvironment ? environmentRadiance(direction) : vec3(0.0); }

// Weight of what a scattered ray met, against the light sampling that could have found it too. scatter_pdf: solid angle.
float weightOfSky(float scatter_pdf, vec3 direction) {
    if (!kDirectMis || frame.environment_light == kNoIndex) return 1.0;
    return misWeight(scatter_pdf, lights[frame.environment_light].pmf * pdfEnvironment(direction));
}

float weightOfSurface(float scatter_pdf, Surface s, vec3 from, vec3 direction) {
    if (!kDirectMis || !kLightTriangles || s.light == kNoIndex || lights[s.light].pmf <= 0.0) return 1.0;
    vec3 d = s.position - from;
    return misWeight(scatter_pdf, pdfTriangleLight(s, dot(d, d), direction));
}

// Radiance along wo (unit, world, away from the scene) of a path whose first vertex is `hit`.
vec3 pathRadiance(Hit hit, vec3 wo, inout PathCounts counts) {
    if (hit.instance == kNoIndex) return skyRadiance(-wo);
    vec3 radiance = vec3(0.0);
    vec3 throughput = vec3(1.0);
    vec3 from = vec3(0.0);      // the vertex before
    float scatter_pdf = 0.0;    // of the direction that led here

    for (uint bounce = 0u;; ++bounce) {
        // What the surface emits: T^bounce Le. Seen directly it counts whole.
        Surface s = surfaceAt(hit, wo);
        if (kEmission || kUnlit) radiance += throughput * s.emission * (bounce == 0u ? 1.0 : weightOfSurface(scatter_pdf, s, from, -wo));
        if (bounce >= frame.bounces) break;

        // Sample a light.
        uint dimension = kDimensionBounce + kDimensionsPerBounce * bounce;
        vec3 wo_local = localFromWorld(s.frame, wo);
        if (kLightTriangles || kPunctualLights || kEnvironment) radiance += throughput * directLight(s, wo_local, dimension, counts);

        // Sample the BSDF.
        vec4 u = sample4(g_address, dimension + kDimensionScatter);
        BsdfSample scattered = bsdfSample(s.bsdf, wo_local, u.x, u.yz);
        if (!scattered.valid) break;
        vec3 wi = worldFromLocal(s.frame, scattered.wi);
        if (dot(wi, s.face_normal) <= 0.0) break;  // below the true surface: absorbed
        throughput *= scattered.weight;
        if (largest(throughput) <= 0.0) break;

        // Roulette: end a path that carries little, by a chance that keeps the mean.
        if (bounce >= frame.roulette_start) {
            float survival = min(largest(throughput), 1.0);
            if (u.w >= survival) break;
            throughput /= survival;
        }

        // Follow the ray.
        ++counts.bounce_rays;
        hit = traceNearest(offsetOrigin(s, wi), wi);
        wo = -wi;
        from = s.position;
        scatter_pdf = scattered.pdf;
        if (hit.instance == kNoIndex) {
            if (kEnvironment) radiance += throughput * weightOfSky(scatter_pdf, wi) * skyRadiance(wi);
            break;
        }
    }
    return radiance;
}

#endif
