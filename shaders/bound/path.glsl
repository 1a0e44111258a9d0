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

// Light that would arrive straight from a sampled light and scatter towards wo, one order of T applied to Le; `ray` asks whether it does.
vec3 directLight(Surface s, vec3 wo_local, uint dimension, out RayQuery ray) {
    ray = kNoRayQuery;
    LightSample light = sampleLight(s, g_address, dimension);
    if (!light.valid) return vec3(0.0);
    vec3 wi = normalize(light.direction);
    if (dot(wi, s.face_normal) <= 0.0) return vec3(0.0);
    vec3 wi_local = localFromWorld(s.frame, wi);
    vec3 f = bsdfEvaluate(s.bsdf, wo_local, wi_local);
    if (largest(f) <= 0.0) return vec3(0.0);
    ray = RayQuery(offsetOrigin(s, wi), light.direction, light.t_max, true);
    float weight = light.delta ? 1.0 : misWeight(light.pdf, bsdfPdf(s.bsdf, wo_local, wi_local));
    return f * light.radiance * (wi_local.z * weight / light.pdf);
}

vec3 skyRadiance(vec3 direction) { return kEnvironment ? environmentRadiance(direction) : vec3(0.0); }

// Weight of what a scattered ray met, against the light sampling that could have found it too. scatter_pdf: solid angle.
float weightOfSky(float scatter_pdf, vec3 direction) {
    if (!kDirectMis || frame.environment_light == kNoIndex) return 1.0;
    return misWeight(scatter_pdf, lightAt(frame.environment_light).pmf * pdfEnvironment(direction));
}

float weightOfSurface(float scatter_pdf, Surface s, vec3 from, vec3 direction) {
    if (!kDirectMis || !kLightTriangles || s.light == kNoIndex || lightAt(s.light).pmf <= 0.0) return 1.0;
    vec3 d = s.position - from;
    return misWeight(scatter_pdf, pdfTriangleLight(s, dot(d, d), direction));
}

// A path on its way.
struct Path {
    Hit hit;             // the next vertex; kNoIndex: it has left the scene
    vec3 wo;             // unit, world, from there to the vertex before
    vec3 radiance;       // found so far
    vec3 throughput;
    vec3 from;           // the vertex before
    float scatter_pdf;   // of the direction that led to `hit`, solid angle
    uint bounce;         // scattered so often
    bool alive;
};

// wo: unit, world, away from the scene.
Path beginPath(Hit hit, vec3 wo) { return Path(hit, wo, vec3(0.0), vec3(1.0), vec3(0.0), 0.0, 0u, true); }

// What a path that left the scene finds there. Seen directly the sky counts whole.
void endInSky(inout Path p) {
    if (kEnvironment || p.bounce == 0u) p.radiance += p.throughput * (p.bounce == 0u ? 1.0 : weightOfSky(p.scatter_pdf, -p.wo)) * skyRadiance(-p.wo);
    p.alive = false;
}

// One vertex of the path: what is emitted there (added to its radiance), what arrives there from a light if `light_ray` is not blocked, and where the
// path goes on. `path_ray` is wanted while the path is alive; the path then waits for what it hits.
vec3 extendPath(inout Path p, out RayQuery light_ray, out RayQuery path_ray) {
    light_ray = kNoRayQuery;
    path_ray = kNoRayQuery;
    // What the surface emits: T^bounce Le. Seen directly it counts whole.
    Surface s = surfaceAt(p.hit, p.wo);
    if (kEmission || kUnlit) p.radiance += p.throughput * s.emission * (p.bounce == 0u ? 1.0 : weightOfSurface(p.scatter_pdf, s, p.from, -p.wo));
    p.alive = p.bounce < frame.bounces;
    if (!p.alive) return vec3(0.0);

    // Sample a light.
    uint dimension = kDimensionBounce + kDimensionsPerBounce * p.bounce;
    vec3 wo_local = localFromWorld(s.frame, p.wo);
    vec3 direct = vec3(0.0);
    if (kLightTriangles || kPunctualLights || kEnvironment) direct = p.throughput * directLight(s, wo_local, dimension, light_ray);

    // Sample the BSDF.
    vec4 u = sample4(g_address, dimension + kDimensionScatter);
    BsdfSample scattered = bsdfSample(s.bsdf, wo_local, u.x, u.yz);
    vec3 wi = worldFromLocal(s.frame, scattered.wi);
    p.throughput *= scattered.weight;
    p.alive = scattered.valid && dot(wi, s.face_normal) > 0.0 && largest(p.throughput) > 0.0;  // below the true surface: absorbed

    // Roulette: end a path that carries little, by a chance that keeps the mean.
    if (p.alive && p.bounce >= frame.roulette_start) {
        float survival = min(largest(p.throughput), 1.0);
        p.alive = u.w < survival;
        p.throughput /= survival;
    }

    // Follow the ray.
    if (p.alive) {
        path_ray = RayQuery(offsetOrigin(s, wi), wi, uintBitsToFloat(0x7f800000u), true);
        p.wo = -wi;
        p.from = s.position;
        p.scatter_pdf = scattered.pdf;
        ++p.bounce;
    }
    return direct;
}

// The same, with both rays traced.
void extendAndTrace(inout Path p, inout PathCounts counts) {
    RayQuery light_ray, path_ray;
    vec3 direct = extendPath(p, light_ray, path_ray);
    if (light_ray.wanted) {
        ++counts.shadow_rays;
        if (!occluded(light_ray.origin, light_ray.direction, light_ray.t_max)) p.radiance += direct;
    }
    if (path_ray.wanted) {
        ++counts.bounce_rays;
        p.hit = traceNearest(path_ray.origin, path_ray.direction);
    }
}

// Radiance along wo of a path whose first vertex is `hit`.
vec3 pathRadiance(Hit hit, vec3 wo, inout PathCounts counts) {
    Path p = beginPath(hit, wo);
    while (p.alive) {
        if (p.hit.instance == kNoIndex) {
            endInSky(p);
        } else {
            extendAndTrace(p, counts);
        }
    }
    return p.radiance;
}

#endif
