// The estimator: L = sum over i of T^i Le along one random path.
// Kajiya 1986, The Rendering Equation; Veach 1997, Robust Monte Carlo Methods for Light Transport Simulation.
#ifndef LICHT_PATH_PATH_GLSL
#define LICHT_PATH_PATH_GLSL

#include "light/light.glsl"
#include "shared/choices.h"
#include "shared/constants.h"
#include "shared/dimensions.h"
#include "shared/index.h"
#include "shared/light.h"

layout(constant_id = kConstantDirect) const uint kDirect = kDirectMis;
layout(constant_id = kConstantMisBalance) const bool kMisBalance = false;
layout(constant_id = kConstantClamp) const bool kClamp = false;
layout(constant_id = kConstantRegularise) const bool kRegularise = false;
layout(constant_id = kConstantSignals) const bool kSignals = false;  // light is kept apart by the lobes of the first vertex
layout(constant_id = kConstantReprojects) const bool kReprojects = false;  // and what it mirrors has a distance

// Ways by which light came to the first vertex.
const uint kWayToLight = 0u;
const uint kWayOnward = 1u;

// What is counted beside the light; see CounterRecord.
struct PathCounts {
    uint bounce_rays;
    uint shadow_rays;
    uint truncated_traversals;
    uint environment_samples;
    uint environment_tries;
};

const PathCounts kNothingCounted = PathCounts(0u, 0u, 0u, 0u, 0u);

void countTries(LightSample light, inout PathCounts counts) {
    if (!kEnvironment || kEnvironmentSampling != kEnvironmentRejection || light.tries == 0u) return;
    ++counts.environment_samples;
    counts.environment_tries += light.tries;
}

// Weight of a technique of density pdf where another one finds the same light with other_pdf; a technique that is off finds nothing.
float misWeight(float pdf, float other_pdf) { return kMisBalance ? balanceWeight(pdf, other_pdf) : powerWeight(pdf, other_pdf); }

float weightOfLightSample(LightSample light, float scatter_pdf) { return kDirect == kDirectArea || light.delta ? 1.0 : misWeight(light.pdf, scatter_pdf); }

// light_pdf: with which light sampling would have found what scattering met; 0: not at all.
float weightOfScattering(float scatter_pdf, float light_pdf) {
    if (kDirect == kDirectHemisphere || light_pdf <= 0.0) return 1.0;
    return kDirect == kDirectArea ? 0.0 : misWeight(scatter_pdf, light_pdf);
}

// Of the light of a way, the share that the lobes which spread it evenly send on.
vec3 shareOfSpread(vec3 spread_f, vec3 f) { return mix(vec3(0.0), spread_f / f, greaterThan(f, vec3(0.0))); }

vec3 shareOfSpread(Bsdf b, vec3 wo, vec3 wi) {
    vec3 spread_f;
    vec3 f = evaluateBsdf(b, wo, wi, spread_f).f;
    return shareOfSpread(spread_f, f);
}

// A path on its way.
struct Path {
    SampleAddress address;  // of the sample that it is
    Hit hit;                // the next vertex; kNoIndex: it has left the scene
    vec3 wo;                // unit, world, from there to the vertex before
    vec3 radiance;          // found so far
    vec3 throughput;
    PackedShadingPoint from;  // the vertex before, as lights are chosen for it
    float scatter_pdf;      // of the direction that led to `hit`, solid angle
    uint bounce;            // scattered so often
    uint medium;            // that it goes through; kNoIndex: vacuum
    bool alive;
};

// What the camera's ray, the first one, met. wo: unit, world, away from the scene.
Path beginPath(SampleAddress address, Hit hit, vec3 wo) {
    return Path(address, hit, wo, vec3(0.0), vec3(1.0), kNoShadingPoint, 0.0, 0u, kNoIndex, true);
}

// The including shader defines what else happens (path/watch.glsl): to light that a path found along the way on which it left its first vertex, and to rays
// that looked for light of an order; to that vertex, to how its lobes share the light of a way, and to the way from there to the next.
void onLight(uvec2 pixel, uint order, uint way, vec3 kept, vec3 lost);
void onRays(uvec2 pixel, uint order, uint rays);
void onFirstVertex(uvec2 pixel, Surface s, vec3 wo_local);
void onFirstWay(uvec2 pixel, uint way, vec3 share_of_spread);
void onSecondVertex(uvec2 pixel, uint instance, float distance_);

// Light that would arrive straight from a sampled light and scatter towards wo, one order of T applied to Le, with the ray that asks whether it does.
// One sample of the lights: several at what the camera sees, and several candidates of which one is kept (Talbot, Cline, Egbert 2005, Importance Resampling
// for Global Illumination), take as much more time as they take noise away, where there are many lamps.
ShadowRay directLight(Surface s, PackedShadingPoint at, vec3 wo_local, uint dimension, Path p, inout PathCounts counts) {
    LightSample light = sampleLight(vertexOn(s), at, p.address, dimension);
    countTries(light, counts);
    if (!light.valid) return kNoShadowRay;
    vec3 wi = normalize(light.direction);
    if (dot(wi, s.face_normal) <= 0.0) return kNoShadowRay;
    vec3 wi_local = localFromWorld(s.frame, wi);
    vec3 spread_f;
    LobeValue scattered = evaluateBsdf(s.bsdf, wo_local, wi_local, spread_f);
    if (largest(scattered.f) <= 0.0) return kNoShadowRay;
    if (kSignals && kGlossy && p.bounce == 0u) onFirstWay(p.address.pixel, kWayToLight, shareOfSpread(spread_f, scattered.f));
    float weight = weightOfLightSample(light, scattered.pdf);
    vec3 arriving = scattered.f * light.radiance * (wi_local.z * weight / light.pdf);
    RayQuery query = shadowQuery(offsetOrigin(vertexOn(s), wi), light.direction, light.t_max, light.t_enough);
    return ShadowRay(sceneRay(query, p.address, kRayToLight + kRaysPerBounce * p.bounce), light.target, arriving, true);
}

// Light found by a path that applied T `order` times: one term of the Neumann series.
vec3 foundLight(uvec2 pixel, uint order, uint way, vec3 light) {
    vec3 kept = light;
    if (kClamp && order > 1u) {
        float brightest = largest(light);
        if (brightest > frame.clamp_limit) kept *= frame.clamp_limit / brightest;
    }
    onLight(pixel, order, way, kept, light - kept);
    return kept;
}

// What a ray to a light brings, now that it is traced.
vec3 arrivingLight(uvec2 pixel, uint order, ShadowRay shadow) {
    vec3 share = arrivingShare(shadow);
    return largest(share) > 0.0 ? foundLight(pixel, order, order == 1u ? kWayToLight : kWayOnward, share * shadow.light) : vec3(0.0);
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
    if (kEnvironment || kSuns) p.radiance += foundLight(p.address.pixel, p.bounce, kWayOnward, light);
    p.alive = false;
}

// Whether a picture is opaque there: a surface, an environment, a sun's disc.
bool isOpaqueInPicture(Hit hit, vec3 wo) {
    bool covered = hit.instance != kNoIndex || frame.has_sky != 0u;
    if (kSuns) {
        for (uint i = 0u; i < frame.suns; ++i) covered = covered || isInSun(lightAt(frame.first_sun + i), -wo);
    }
    return covered;
}

// One vertex of the path: what is emitted there (added to its radiance), what arrives there from a light if `to_light` is not blocked, and where the path
// goes on. While the path is alive `onward` is wanted; the path then waits for what it hits.
void extendPath(inout Path p, inout PathCounts counts, out ShadowRay to_light, out SceneRay onward) {
    to_light = kNoShadowRay;
    // What the surface emits: T^bounce Le.
    Surface s = surfaceAt(p.hit, p.wo);
    if (kReprojects && kGlossy && p.bounce == 1u) onSecondVertex(p.address.pixel, p.hit.instance, distance(s.position, p.from.position));
    if (kRegularise && p.bounce > 0u) s.bsdf = regularised(s.bsdf);
    if (kUnlit && s.unlit && p.bounce > 0u) s.emission = vec3(0.0);
    if (kEmission || kUnlit) {
        p.radiance += foundLight(p.address.pixel, p.bounce, kWayOnward, p.throughput * weightOfMeeting(p, pdfOfSurface(s, p.from)) * s.emission);
    }
    p.alive = p.bounce < frame.bounces;
    if (!p.alive) return;

    // Sample a light.
    uint dimension = kDimensionBounce + kDimensionsPerBounce * p.bounce;
    vec3 wo_local = localFromWorld(s.frame, p.wo);
    if (kSignals && p.bounce == 0u) onFirstVertex(p.address.pixel, s, wo_local);
    PackedShadingPoint at = shadingPointAt(s, p.wo);
    if (kLightTriangles || kPunctualLights || kEnvironment) to_light = directLight(s, at, wo_local, dimension, p, counts);
    to_light.light *= p.throughput;

    // Sample the BSDF: the direction by the pair of numbers that is spread evenly together.
    vec4 u = sample4(p.address, dimension + kDimensionScatter);
    BsdfSample scattered = sampleBsdf(s.bsdf, wo_local, u.z, u.xy);
    vec3 wi = worldFromLocal(s.frame, scattered.wi);
    if (kSignals && kGlossy && p.bounce == 0u) onFirstWay(p.address.pixel, kWayOnward, shareOfSpread(s.bsdf, wo_local, scattered.wi));
    p.throughput *= scattered.weight;
    p.alive = scattered.valid && dot(wi, s.face_normal) > 0.0 && largest(p.throughput) > 0.0;  // below the true surface: absorbed

    // Roulette: end a path that carries little, by a chance that keeps the mean.
    if (p.alive && p.bounce >= frame.roulette_start) {
        float survival = min(largest(p.throughput), 1.0);
        p.alive = u.w < survival;
        p.throughput /= survival;
    }

    onRays(p.address.pixel, p.bounce + 1u, (to_light.wanted ? 1u : 0u) + (p.alive ? 1u : 0u));

    // Follow the ray.
    if (p.alive) {
        onward = sceneRay(pathQuery(offsetOrigin(vertexOn(s), wi), wi), p.address, kRayOnward + kRaysPerBounce * p.bounce);
        p.wo = -wi;
        p.from = at;
        p.scatter_pdf = scattered.pdf;
        ++p.bounce;
    }
}

// The same, with both rays traced: from vertex to vertex. A sample is a path that is begun, extended while it hits something, and ended in the sky where it
// does not.
void extendAndTrace(inout Path p, inout PathCounts counts) {
    ShadowRay to_light;
    SceneRay onward;
    uint order = p.bounce + 1u;
    extendPath(p, counts, to_light, onward);
    if (to_light.wanted) {
        ++counts.shadow_rays;
        trace(to_light.ray);
        counts.truncated_traversals += to_light.ray.truncated ? 1u : 0u;
        p.radiance += arrivingLight(p.address.pixel, order, to_light);
    }
    if (p.alive) {
        ++counts.bounce_rays;
        trace(onward);
        counts.truncated_traversals += onward.truncated ? 1u : 0u;
        p.hit = onward.hit;
    }
}

#endif
