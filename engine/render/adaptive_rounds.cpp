#include "licht/render/adaptive_rounds.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "licht/shared/frame.h"

namespace licht {

AdaptiveRounds::AdaptiveRounds(gpu::Device& device, uvec2 size, std::uint32_t first_sample)
    : film_(size),
      size_(size),
      first_sample_(first_sample),
      records_(device, "adaptive tiles", film_.tiles() * sizeof(AdaptiveTileRecord),
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Memory::host_write) {
    restart();
}

void AdaptiveRounds::restart() {
    film_ = AdaptiveFilm(size_);
    budget_ = 0;
    frames_ = 0;
    frames_before_ = 0;
    drawn_.assign(film_.tiles(), 0);
    plan_.assign(film_.tiles(), 0);
    const std::vector<AdaptiveTileRecord> all(film_.tiles(), {~0U, 0U});
    std::memcpy(records_.mapped(), all.data(), all.size() * sizeof(all[0]));
}

void AdaptiveRounds::begin(std::uint32_t budget) {
    budget_ = budget;
    plan_ = film_.plan(budget);
    frames_ = *std::max_element(plan_.begin(), plan_.end());
    std::vector<AdaptiveTileRecord> tiles(plan_.size());
    for (std::size_t i = 0; i < tiles.size(); ++i)
        tiles[i] = {first_sample_ + frames_before_ + plan_[i], frames_before_ - drawn_[i]};
    std::memcpy(records_.mapped(), tiles.data(), tiles.size() * sizeof(tiles[0]));
}

void AdaptiveRounds::end(std::uint32_t frames, std::span<const std::byte> mean_high,
                         std::span<const std::byte> squares_high) {
    assert(frames == frames_ || (film_.samples() == 0 && frames > 0 && frames < frames_));
    if (frames < frames_) {
        budget_ = frames;
        plan_.assign(plan_.size(), frames);
    }
    film_.fold(budget_, plan_, mean_high, squares_high);
    for (std::size_t i = 0; i < drawn_.size(); ++i) drawn_[i] += plan_[i];
    frames_before_ += frames;
    frames_ = 0;
}

double AdaptiveRounds::samples(std::uint32_t frames) const {
    double drawn = film_.samples();
    if (frames_ == 0) return drawn;
    for (std::size_t i = 0; i < plan_.size(); ++i) drawn += std::min(frames, plan_[i]) * film_.tileShare(i);
    return drawn;
}

}  // namespace licht
