// The estimator: L = sum over i of T^i Le along one random path.
// Kajiya 1986, The Rendering Equation; Veach 1997, Robust Monte Carlo Methods for Light Transport Simulation.
#ifndef LICHT_BOUND_PATH_GLSL
#define LICHT_BOUND_PATH_GLSL

#include "bound/light.glsl"
#include "shared/choices.h"
#include "shared/constants.h"
#include "shared/dimensions.h"
#include "shared/index.h"
#include "shared/light.h"

layout(constant_id = kConstantDirect) const uint kDirect = kDirectMis;
layout(constant_id = kConstantMisBalance) const bool kMisBalance = false;
layout(constant_id = kConstantClamp) const bool kClamp = false;
layout(constant_id = kConstantRegularise) const bool kRegularise = false;

struct PathCounts {
    uint bounce_rays;
    uint shadow_rays;
};

// Weight of a technique of density pdf where another one finds the same light with other_pdf; a technique that is off finds nothing.
float misWeight(float pdf, float other_pdf) { return kMisBalance ? balanceWeight(pdf, other_pdf) : powerWeight(pdf, other_pdf); }

float weightOfLightSample(LightSample light, float scatter_pdf) { return kDirect == kDirectArea || light.delta ? 1.0 : misWeight(light.pdf, scatter_pdf); }

// light_pdf: with which light sampling would have found what scattering met; 0: not at all.
float weightOfScattering(float scatter_pdf, float light_pdf) {
    if (kDirect == kDirectHemisphere || light_pdf <= 0.0) return 1.0;
    return kDirect == kDirectArea ? 0.0 : misWeight(scatter_pdf, light_pdf);
}

// Light that would arrive straight from a sampled light and scatter towards wo, one order of T applied to Le; `ray` asks whether it does.
// One sample of the lights: several at what the camera sees, and several candidates of which one is kept (Talbot 2005), were both tried where there are 200 lamps: less
// noise a sample by 1.3 to 1.6, for as much more time.
vec3 directLight(Surface s, LightAsker asker, vec3 wo_local, uint dimension, out RayQuery ray) {
    ray = kNoRayQuery;
    LightSample light = sampleLight(s, asker, g_address, dimension);
    if (!light.valid) return vec3(0.0);
    vec3 wi = normalize(light.direction);
    if (dot(wi, s.face_normal) <= 0.0) return vec3(0.0);
    vec3 wi_local = localFromWorld(s.frame, wi);
    LobeValue scattered = evaluateBsdf(s.bsdf, wo_local, wi_local);
    if (largest(scattered.f) <= 0.0) return vec3(0.0);
    ray = RayQuery(offsetOrigin(s, wi), light.direction, light.t_max, true, light.target, light.t_enough);
    float weight = weightOfLightSample(light, scattered.pdf);
    return scattered.f * light.radiance * (wi_local.z * weight / light.pdf);
}

// A path on its way.
struct Path {
    Hit hit;             // the next vertex; kNoIndex: it has left the scene
    vec3 wo;             // unit, world, from there to the vertex before
    vec3 radiance;       // found so far
    vec3 throughput;
    LightAsker from;     // the vertex before, as it asks for lights
    float scatter_pdf;   // of the direction that led to `hit`, solid angle
    uint bounce;         // scattered so often
    bool alive;
};

// wo: unit, world, away from the scene.
Path beginPath(Hit hit, vec3 wo) { return Path(hit, wo, vec3(0.0), vec3(1.0), kNobody, 0.0, 0u, true); }

// The including shader defines what else happens to light that a path found, and to the rays that looked for light of an order: nothing, or a note.
void onLight(uint order, vec3 kept, vec3 lost);
void onRays(uint order, uint rays);

// Light found by a path that applied T `order` times: one term of the Neumann series.
vec3 foundLight(uint order, vec3 light) {
    vec3 kept = light;
    if (kClamp && order > 1u) {
        float brightest = largest(light);
        if (brightest > frame.clamp_limit) kept *= frame.clamp_limit / brightest;
    }
    onLight(order, kept, light - kept);
    return kept;
}

// Weight of light that the path meets. Seen directly it counts whole.
float weightOfMeeting(Path p, float light_pdf) { return p.bounce == 0u ? 1.0 : weightOfScattering(p.scatter_pdf, light_pdf); }

// What suns send along the way that the path left by. Where they overlap, each is an integral of its own.
vec3 metSuns(Path p) {
    vec3 light = vec3(0.0);
    for (uint i = 0u; i < frame.suns; ++i) {
        LightRecord sun = lightAt(frame.first_sun + i);
        if (isInSun(sun, -p.wo)) light += weightOfMeeting(p, pdfOfSun(sun)) * radianceOfSun(sun);
    }
    return light;
}

// What a path that left the scene finds there.
void endInSky(inout Path p) {
    vec3 light = vec3(0.0);
    if (kEnvironment) light = p.throughput * weightOfMeeting(p, pdfOfSky(-p.wo)) * environmentRadiance(-p.wo);
    if (kSuns) light += p.throughput * metSuns(p);
    if (kEnvironment || kSuns) p.radiance += foundLight(p.bounce, light);
    p.alive = false;
}

// Whether a picture is opaque there: a surface, an environment, a sun's disc.
bool covers(Hit hit, vec3 wo) {
    bool covered = hit.instance != kNoIndex || frame.has_sky != 0u;
    if (kSuns) {
        for (uint i = 0u; i < frame.suns; ++i) covered = covered || isInSun(lightAt(frame.first_sun + i), -wo);
    }
    return covered;
}

// One vertex of the path: what is emitted there (added to its radiance), what arrives there from a light if `light_ray` is not blocked, and where the
// path goes on. `path_ray` is wanted while the path is alive; the path then waits for what it hits.
vec3 extendPath(inout Path p, out RayQuery light_ray, out RayQuery path_ray) {
    light_ray = kNoRayQuery;
    path_ray = kNoRayQuery;
    // What the surface emits: T^bounce Le.
    Surface s = surfaceAt(p.hit, p.wo);
    if (kRegularise && p.bounce > 0u) s.bsdf = regularised(s.bsdf);
    if (kEmission || kUnlit) {
        p.radiance += foundLight(p.bounce, p.throughput * weightOfMeeting(p, pdfOfSurface(s, p.from)) * s.emission);
    }
    p.alive = p.bounce < frame.bounces;
    if (!p.alive) return vec3(0.0);

    // Sample a light.
    uint dimension = kDimensionBounce + kDimensionsPerBounce * p.bounce;
    vec3 wo_local = localFromWorld(s.frame, p.wo);
    vec3 direct = vec3(0.0);
    LightAsker asker = askerAt(s, p.wo);
    if (kLightTriangles || kPunctualLights || kEnvironment) direct = p.throughput * directLight(s, asker, wo_local, dimension, light_ray);

    // Sample the BSDF: the direction by the pair of numbers that is spread evenly together.
    vec4 u = sample4(g_address, dimension + kDimensionScatter);
    BsdfSample scattered = sampleBsdf(s.bsdf, wo_local, u.z, u.xy);
    vec3 wi = worldFromLocal(s.frame, scattered.wi);
    p.throughput *= scattered.weight;
    p.alive = scattered.valid && dot(wi, s.face_normal) > 0.0 && largest(p.throughput) > 0.0;  // below the true surface: absorbed

    // Roulette: end a path that carries little, by a chance that keeps the mean.
    if (p.alive && p.bounce >= frame.roulette_start) {
        float survival = min(largest(p.throughput), 1.0);
        p.alive = u.w < survival;
        p.throughput /= survival;
    }

    onRays(p.bounce + 1u, (light_ray.wanted ? 1u : 0u) + (p.alive ? 1u : 0u));

    // Follow the ray.
    if (p.alive) {
        path_ray = RayQuery(offsetOrigin(s, wi), wi, uintBitsToFloat(0x7f800000u), true, kNoIndex, 0.0);
        p.wo = -wi;
        p.from = asker;
        p.scatter_pdf = scattered.pdf;
        ++p.bounce;
    }
    return direct;
}

// The same, with both rays traced.
void extendAndTrace(inout Path p, inout PathCounts counts) {
    RayQuery light_ray, path_ray;
    uint order = p.bounce + 1u;
    vec3 direct = extendPath(p, light_ray, path_ray);
    if (light_ray.wanted) {
        ++counts.shadow_rays;
        if (lightArrives(light_ray)) p.radiance += foundLight(order, direct);
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
