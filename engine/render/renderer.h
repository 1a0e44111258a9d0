#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "licht/bvh/bvh.h"
#include "licht/gpu/commands.h"
#include "licht/image/image.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/shared/records.h"

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

/// What was accumulated so far, on the host. Planes are width * height, from the top left.
struct Film {
    uvec2 size{0};
    std::uint32_t samples = 0;
    Image mean;      ///< RGBA: linear radiance, cd/m^2; alpha: share of samples that saw surface, sky or sun
    Image variance;  ///< RGB: estimated variance of the mean above (zero while samples < 2)
    Image counts;    ///< samples per pixel, where they differ; `samples` is then their mean
    Image albedo;    ///< RGB, when asked for
    Image normal;    ///< XYZ, unit or zero, when asked for
    Image depth;     ///< when asked for; infinite where nothing was hit
    Image motion;    ///< XY, when asked for
    std::vector<Image> orders;  ///< RGB of T^i Le each, when asked for; they sum to the mean
    Image lost;                 ///< RGB: what the clamp took, where it is on
};

/// Means over the picture, RGB in cd/m^2, of samples that followed one another: batches tell how sure the
/// mean of all of them is.
struct LightBatch {
    std::uint32_t samples = 0;       ///< of every pixel
    std::vector<glm::dvec3> orders;  ///< T^i Le
    glm::dvec3 lost{0.0};            ///< what the clamp took
};

/// Merges two films of disjoint sample ranges (Chan, Golub, LeVeque 1979, Updating Formulae and a Pairwise
/// Algorithm for Computing Sample Variances).
Film mergeFilms(const Film& a, const Film& b);

/// sqrt of the estimated relMSE: mean over pixels and channels of variance of the mean / (mean^2 + 0.01 *
/// (the picture's mean)^2). Negative while it is unknown (fewer than two samples). As if samples were
/// independent: for those of an even sequence ErrorEstimate (error_estimate.h) is closer.
double relativeError(const Film& film);

enum class Tonemap : std::uint32_t { none, neutral, agx, aces };

struct RenderStatistics {
    double bvh_seconds = 0.0;
    double upload_seconds = 0.0;
    double pipeline_seconds = 0.0;
    std::uint64_t geometry_bytes = 0;  ///< on the device: vertices, triangles, instances and the BVH
    std::map<std::string, gpu::PassTime> passes;
    std::uint64_t primary_rays = 0;  ///< pixels rasterised times samples
    std::uint64_t bounce_rays = 0;
    std::uint64_t shadow_rays = 0;
    std::uint64_t nonfinite_samples = 0;
    /// Samples in which a driver that limits the loops of a shader ended a BVH traversal early: they may have
    /// missed a surface.
    std::uint64_t cut_walks = 0;
    /// Directions to the environment that rejection drew, and how many it tried for them.
    std::uint64_t environment_samples = 0;
    std::uint64_t environment_tries = 0;
    std::vector<std::uint64_t>
        order_rays;  ///< per order T^i Le, where they are kept: rays that looked for it
};

/// The frame, in order: gbuffer -> trace -> accumulate -> tonemap. Offscreen and windowed use the same one.
class Renderer {
public:
    /// Builds the BVH, uploads and compiles. The device must outlive the renderer; the scene need not.
    /// Throws InputError when the scene does not fit the device's limits (with the numbers).
    Renderer(gpu::Device& device, const Scene& scene, const Camera& camera, const RenderSettings& settings);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;
    ~Renderer();

    /// Records and submits one sample per pixel; returns while the device works, with at most two frames in
    /// flight.
    void renderSample();
    /// settings.adaptive: samples are drawn in rounds of `samples` (at least one) per pixel on average,
    /// spread as the noise of the rounds before calls for. renderSample() then renders a frame of the round,
    /// in which some tiles take part; while the round is not done, end it only if it is the first.
    void beginRound(std::uint32_t samples);
    [[nodiscard]] bool roundDone() const;
    void endRound();
    /// Waits for everything submitted.
    void finish();
    /// Per pixel; on average where they differ, rounded down.
    [[nodiscard]] std::uint32_t samples() const;

    /// Moves the camera; the history starts anew when the view differs.
    void setCamera(const Camera& camera);
    /// Changes the picture's size; the history starts anew.
    void resize(uvec2 size);

    [[nodiscard]] Film readFilm();
    /// The tone-mapped picture, display-referred sRGB in [0,1], RGBA.
    [[nodiscard]] Image readDisplay(Tonemap curve, float exposure_ev);
    /// Records the tone map into an RGBA8/BGRA8 image of the same size; used by the window. `commands` must
    /// be recording.
    void recordDisplay(gpu::Commands& commands, Tonemap curve, float exposure_ev);
    /// The image recordDisplay writes: R8G8B8A8_UNORM, already sRGB-encoded.
    [[nodiscard]] const gpu::Image& displayImage() const;

    /// Of the samples that readFilm saw last, where orders are kept or the clamp is on; otherwise none.
    [[nodiscard]] std::vector<LightBatch> lightBatches() const;
    [[nodiscard]] const Effects& effects() const;
    [[nodiscard]] RenderStatistics statistics() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace licht
