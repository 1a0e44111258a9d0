#pragma once
// How far the pictures of a moving camera are from the converged picture of the same frame, for each way of
// taking noise out of them.
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "licht/gpu/device.h"
#include "licht/run/path_frame.h"
#include "licht/run/recovery.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"

namespace licht {

inline constexpr std::array kTemporalModes{Denoise::none, Denoise::temporal, Denoise::spatiotemporal};

struct TemporalFrame {
    double seconds = 0.0;  ///< of rendering and filtering
    double rel_mse = 0.0;  ///< against the frame's truth, whose own error is taken off
    double flip = 0.0;     ///< how much of the difference to it is seen
};

/// A mean over pixels, and how sure it is; negative standard error: there were no two.
struct MeanOfPixels {
    double value = 0.0;
    double standard_error = -1.0;
    std::uint64_t pixels = 0;
};

struct TemporalMode {
    Denoise mode = Denoise::none;
    std::vector<TemporalFrame> frames;  ///< of mode none each frame's samples alone, though the camera rests
    /// Mean |(out_t - out_t-1) - (ref_t - ref_t-1)| over the references' mean, without cuts.
    double flicker = 0.0;
    /// Relative squared error beyond that of mode none where a frame shows what the one before did not: what
    /// is brought there from elsewhere. Zero on average where nothing is.
    MeanOfPixels ghost;
    /// Empty for mode none, which has no history that could be too old.
    Recoveries recoveries;

    // Means over the frames; zero where there are none.
    [[nodiscard]] double relMse() const;
    [[nodiscard]] double flip() const;
    [[nodiscard]] double seconds() const;
};

struct TemporalAccuracy {
    std::vector<TemporalMode> modes;  ///< as kTemporalModes, and oidn where offersOidn()
    double reference_rel_mse = 0.0;   ///< of the references, mean over the frames; taken off
    std::size_t frames = 0;           ///< that were measured, fewer than the path's where interrupted
};

struct TemporalRequest {
    std::uint32_t samples = 1;              ///< of a frame
    std::uint32_t reference_samples = 512;  ///< of a frame's truth, at least two
};

struct TemporalHooks {
    std::function<bool()> interrupted;
    std::function<void(std::size_t done, std::size_t frames)> progress;
};

/// Of the frames until it is interrupted. `settings`: of the pictures, but for denoise and moves.
TemporalAccuracy measureTemporal(gpu::Device& device, const Scene& scene, std::span<const PathFrame> path,
                                 const RenderSettings& settings, const TemporalRequest& request,
                                 const TemporalHooks& hooks = {});

}  // namespace licht
