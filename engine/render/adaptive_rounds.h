#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "licht/film/adaptive_film.h"
#include "licht/gpu/resource.h"

namespace licht {

/// The rounds of a Renderer, and the records by which its programs know whom to sample.
class AdaptiveRounds {
public:
    AdaptiveRounds(gpu::Device& device, uvec2 size, std::uint32_t first_sample);

    [[nodiscard]] const gpu::Buffer& records() const { return records_; }
    /// The device must be idle.
    void begin(std::uint32_t budget);
    /// `frames` of the round were rendered; fewer than planned only in the first round, which is uniform.
    void end(std::uint32_t frames, std::span<const std::byte> mean_high,
             std::span<const std::byte> squares_high);
    /// Forgets everything.
    void restart();

    [[nodiscard]] std::uint32_t firstFrame() const { return frames_before_; }
    [[nodiscard]] std::uint32_t frames() const { return frames_; }
    /// Samples per pixel on average, with those of `frames` in the present round.
    [[nodiscard]] double samples(std::uint32_t frames) const;
    /// Of the round that ended last.
    [[nodiscard]] std::uint32_t budget() const { return budget_; }
    [[nodiscard]] std::vector<std::uint32_t> pixelCounts() const { return film_.perPixel(plan_); }
    [[nodiscard]] const AdaptiveFilm& film() const { return film_; }

private:
    AdaptiveFilm film_;
    uvec2 size_;
    std::uint32_t first_sample_;
    gpu::Buffer records_;
    std::uint32_t budget_ = 0;
    std::uint32_t frames_ = 0;         ///< of the present round
    std::uint32_t frames_before_ = 0;  ///< of all rounds before it
    std::vector<std::uint32_t> plan_;
    std::vector<std::uint32_t> drawn_;  ///< samples per tile in all rounds before
};

}  // namespace licht
