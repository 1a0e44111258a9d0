#pragma once
// What a picture is asked to be: plain values with the defaults that suit most.
#include <cstdint>

#include "licht/bvh/bvh.h"
#include "licht/core/math.h"
#include "licht/shared/choices.h"

namespace licht {

/// Extra layers beside the beauty picture; each one costs its pass and memory only when it is asked for.
struct AovSet {
    bool albedo = false;
    bool normal = false;  ///< world-space shading normal
    bool depth = false;   ///< distance along the camera's axis, metres
    bool motion = false;  ///< pixels, from the previous view's position to this one's

    [[nodiscard]] bool any() const { return albedo || normal || depth || motion; }
};

/// How direct light is found. mis: next event estimation and scattering combined; hemisphere: scattering
/// alone, the rendering equation over directions; area: next event estimation alone, the equation over
/// surfaces. What only one of them can find (a point light; a surface too large to be worth sampling) is
/// found in every mode.
enum class DirectLight : std::uint32_t {
    mis = kDirectMis,
    hemisphere = kDirectHemisphere,
    area = kDirectArea
};

/// How mis weighs (Veach 1997): by the densities' squares or by the densities.
enum class MisHeuristic : std::uint32_t { power, balance };

/// How one light is picked of many: by a tree over where they are and whom they face, by their power, or all
/// alike.
enum class LightChoice : std::uint32_t { tree = kLightsTree, power = kLightsPower, uniform = kLightsUniform };

/// How a direction towards the environment is drawn; all three have the same density.
enum class EnvironmentSampling : std::uint32_t {
    alias = kEnvironmentAlias,
    inversion = kEnvironmentInversion,
    rejection = kEnvironmentRejection
};

/// Where the numbers come from: an Owen-scrambled Sobol sequence, one whose errors are blue noise over the
/// picture, or independent random numbers.
enum class Sequence : std::uint32_t { sobol = kSamplerSobol, blue = kSamplerBlue, random = kSamplerRandom };

struct RenderSettings {
    uvec2 size{960, 540};
    std::uint32_t bounces = 8;  ///< L = sum of T^i Le for i <= bounces
    /// First bounce that may end a path by chance; >= bounces: never. relMSE after equal time from 2 and from
    /// 3: cornell 0.0070, 0.0061; gallery 0.70, 0.57; hall of lamps 0.147, 0.149. Never: 1.5 times that of 3
    /// in the last two.
    std::uint32_t roulette_start = 3;
    std::uint32_t seed = 0;
    std::uint32_t first_sample = 0;  ///< index of the first sample: ranges rendered apart merge to the whole
    DirectLight direct = DirectLight::mis;
    MisHeuristic mis = MisHeuristic::power;
    LightChoice lights = LightChoice::tree;
    EnvironmentSampling environment_sampling = EnvironmentSampling::inversion;
    Sequence sampler = Sequence::sobol;
    std::uint32_t blue_bits = 4;  ///< blue: log2 of the samples that are well spread together, at most 10
    float clamp =
        0.0F;  ///< cd/m^2 that one indirect contribution may add to a pixel; 0: unlimited (unbiased)
    bool regularise = false;  ///< widen glossy lobes behind a first scattering (biased)
    bool orders = false;      ///< keep a layer per order T^i Le
    bool adaptive = false;    ///< samples are drawn where a mask says so
    AovSet aovs;
    bool all_effects =
        false;  ///< compile everything, called for or not (the reference for the specialised programs)
    BvhQuality bvh_quality = BvhQuality::balanced;
    bool flatten_instances = false;  ///< bake every instance (the reference for two levels)
    bool storage_buffers = false;    ///< fetch BVH and records from storage buffers even where texel buffers
                                     ///< are large enough
    bool queues = false;  ///< small kernels with queues between them instead of one kernel: the same samples
    std::uint32_t paths_per_thread =
        0;                              ///< that a thread follows one after the other; 0: as suits the device
    std::uint32_t rays_per_thread = 0;  ///< of a queue that a thread traces; more than one: in lanes that are
                                        ///< refilled; 0: as suits the device
};

enum class Tonemap : std::uint32_t { none, neutral, agx, aces };

/// Whether paths go through queues; automatic: where that is measured to pay.
enum class QueueUse { automatic, on, off };

}  // namespace licht
