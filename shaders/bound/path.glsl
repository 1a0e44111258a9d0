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

// Radiance along wo (unit, world, away from the scene) of a path whose first vertex is `hit`.
vec3 pathRadiance(Hit hit, vec3 wo, inout PathCounts counts) {
    if (hit.instance == kNoIndex) return skyRadiance(-wo);

    // Emission seen directly: T^0 Le.
    Surface s = surfaceAt(hit, wo);
    vec3 radiance = s.emission;
    vec3 throughput = vec3(1.0);

    for (uint bounce = 0u; bounce < frame.bounces; ++bounce) {
        uint dimension = kDimensionBounce + kDimensionsPerBounce * bounce;
        vec3 wo_local = localFromWorld(s.frame, wo);

        // Sample a light.
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

        // Follow the ray; what it finds is weighted against the light sampling that could have found it too.
        ++counts.bounce_rays;
        vec3 from = s.position;
        hit = traceNearest(offsetOrigin(s, wi), wi);
        wo = -wi;
        if (hit.instance == kNoIndex) {
            if (kEnvironment) {
                float weight = 1.0;
                if (kDirectMis && frame.environment_light != kNoIndex)
                    weight = misWeight(scattered.pdf, lights[frame.environment_light].pmf * pdfEnvironment(wi));
                radiance += throughput * weight * environmentRadiance(wi);
            }
            break;
        }
        s = surfaceAt(hit, wo);
        if (kEmission || kUnlit) {
            float weight = 1.0;
            if (kDirectMis && kLightTriangles && s.light != kNoIndex && lights[s.light].pmf > 0.0) {
                vec3 d = s.position - from;
                weight = misWeight(scattered.pdf, pdfTriangleLight(s, dot(d, d), wi));
            }
            radiance += throughput * weight * s.emission;
        }
    }
    return radiance;
}

#endif
