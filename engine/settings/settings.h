#pragma once
// What a picture is asked to be: plain values with the defaults that suit most. settings_table.h says how
// each is called, what it may be and where it is told.
#include <cstdint>
#include <limits>
#include <optional>

#include "licht/core/math.h"
#include "licht/settings/choices.h"
#include "licht/settings/layers.h"

namespace licht {

struct RenderSettings {
    uvec2 size{960, 540};
    std::uint32_t bounces = 8;         ///< L = sum of T^i Le for i <= bounces
    std::uint32_t roulette_start = 3;  ///< first bounce that may end a path by chance; >= bounces: never
    std::uint32_t seed = 0;
    std::uint32_t first_sample = 0;  ///< index of the first sample: ranges rendered apart merge to the whole
    DirectLight direct = DirectLight::mis;
    MisHeuristic mis = MisHeuristic::power;
    LightChoice lights = LightChoice::tree;
    EnvironmentSampling environment_sampling = EnvironmentSampling::inversion;
    Sequence sampler = Sequence::sobol;
    /// blue: log2 of the samples that are well spread together, at most 10 (blueBitsFor()).
    std::uint32_t blue_bits = 4;
    /// cd/m^2 that one indirect contribution may add to a pixel; 0: unlimited (unbiased).
    float clamp = 0.0F;
    bool regularise = false;  ///< widen glossy lobes behind a first scattering (biased)
    Denoise denoise = Denoise::none;
    bool moves =
        false;  ///< the view will change: the next one has other samples, whose noise would otherwise
                ///< stand before what moves; and with denoise it is told what this one found
    bool scene_moves = false;  ///< and with the view the scene may change (Renderer::setScene)
    Layering layering = Layering::view;
    Energy energy = Energy::multiple;
    bool orders = false;    ///< keep a layer per order T^i Le
    bool adaptive = false;  ///< samples are drawn where a mask says so
    LayerSet layers;        ///< beside the picture; passes and memory only where they are asked for
    /// Compile everything, called for or not (the reference for the specialised programs).
    bool all_effects = false;
    BvhQuality bvh_quality = BvhQuality::balanced;
    bool flatten_instances = false;  ///< bake every instance (the reference for two levels)
    /// Fetch BVH and records from storage buffers even where texel buffers are large enough.
    bool storage_buffers = false;
    bool queues = false;  ///< small kernels with queues between them instead of one kernel: the same samples
    /// That a thread follows one after the other; 0: as suits the device.
    std::uint32_t paths_per_thread = 0;
    /// Of a queue that a thread traces; more than one: in lanes that are refilled; 0: as suits the device.
    std::uint32_t rays_per_thread = 0;
};

/// Whether samples are kept apart by what filters work on: in two independent halves, and by the lobes of
/// what the camera sees.
constexpr bool keepsSignals(const RenderSettings& settings) {
    return settings.denoise == Denoise::spatiotemporal ||
           (settings.denoise == Denoise::temporal && settings.moves);
}

/// Whether something is done about the noise of a view that has none before it.
constexpr bool filtersStills(Denoise denoise) {
    return denoise == Denoise::spatiotemporal || denoise == Denoise::oidn;
}

/// Whether earlier views tell something of the present one.
constexpr bool keepsHistory(const RenderSettings& settings) {
    return settings.denoise != Denoise::none && settings.moves;
}

/// Whether the program was made with OpenImageDenoise, so that a run may have Denoise::oidn.
bool offersOidn();

/// What a run is asked for: the picture, when to stop, and what is left to the program to choose. The first
/// limit that is reached stops a run; without any it draws kDefaultSamples.
struct RunSettings {
    RenderSettings render;
    std::optional<std::uint32_t> samples;  ///< per pixel
    std::optional<double> seconds;         ///< of rendering
    std::optional<double> error;           ///< estimated and relative
    bool auto_bounces = false;             ///< a pilot chooses render.bounces
    QueueUse queues = QueueUse::automatic;
    std::optional<double> exposure;  ///< EV; none: the scene's
    Tonemap tonemap = Tonemap::neutral;
};

/// Per pixel, where neither time nor error says when to stop.
inline constexpr std::uint32_t kDefaultSamples = 64;
/// There are no more: the last one has the index before this.
inline constexpr std::uint32_t kMostSamples = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::uint32_t kMostBounces = 65535;
/// No depth beyond this is chosen: a closed room of albedo one has no depth at which light is spent.
inline constexpr std::uint32_t kMostAutoBounces = 256;
/// Share of the light that may be missing behind a chosen depth where no error was asked for.
inline constexpr double kDefaultTailShare = 0.01;
/// EV, either way: beyond, 2^EV and a float radiance soon have no common range.
inline constexpr double kMostExposure = 64.0;

/// log2 of the samples that sampler blue spreads well together, for a picture of that many per pixel; the
/// default where that is not known.
std::uint32_t blueBitsFor(std::optional<std::uint32_t> samples);

}  // namespace licht
