#pragma once
#include <memory>
#include <vector>

#include "licht/film/film.h"
#include "licht/gpu/commands.h"
#include "licht/render/statistics.h"
#include "licht/scene/effects.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"

namespace licht {

/// How one view follows the other: as a camera moves, so that with settings.moves the one may tell something
/// of the other; or all at once, as if the renderer were new.
enum class ViewChange { motion, cut };

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

    /// Moves the camera; the picture starts anew when the view differs, with what filters keep of it.
    void setCamera(const Camera& camera, ViewChange change = ViewChange::motion);
    /// With settings.scene_moves: the scene is another from the next sample on. Where it has the same
    /// instances of meshes of the same sizes and as many materials, they have moved or changed; otherwise,
    /// and where it calls for effects that are not compiled, all begins anew. Throws InputError as the
    /// constructor does.
    void setScene(const Scene& scene, ViewChange change = ViewChange::motion);
    /// Changes the picture's size; the history starts anew.
    void resize(uvec2 size);

    [[nodiscard]] Film readFilm();
    /// The tone-mapped picture, display-referred sRGB in [0,1], RGBA; or the mean of its samples, before the
    /// filter.
    [[nodiscard]] Image readDisplay(Tonemap curve, float exposure_ev, bool filtered = true);
    /// So, a picture of that size that was made of this renderer's: RGBA, linear.
    [[nodiscard]] Image readDisplay(const Image& picture, Tonemap curve, float exposure_ev);
    /// Records the tone map into an RGBA8/BGRA8 image of the same size; used by the window. `commands` must
    /// be recording.
    void recordDisplay(gpu::Commands& commands, Tonemap curve, float exposure_ev, bool filtered = true);
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
