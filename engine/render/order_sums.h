#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "licht/film/film.h"
#include "licht/gpu/resource.h"

namespace licht {

/// Sums of what paths found, by order T^i Le, and of what the clamp took: one image on the device of a tile
/// of the picture's size each, emptied into sums in double precision from time to time, so that fp32 never
/// stalls.
class OrderSums {
public:
    /// Throws InputError, with the numbers, where the device has no image of that size. At least one tile.
    OrderSums(gpu::Device& device, uvec2 size, std::uint32_t orders, bool lost);

    [[nodiscard]] const gpu::Image& image() const { return image_; }
    /// Whether to fold after that many samples, `folded` of which are folded already: often enough for a
    /// standard error from batches, seldom enough to cost little.
    [[nodiscard]] static bool due(std::uint32_t samples, std::uint32_t folded);
    /// Takes what the device has summed up of samples that count as much as `samples` of every pixel;
    /// `counts`: how many each pixel really got, all `samples` where empty. The device must be idle.
    void fold(std::uint32_t samples, std::span<const std::uint32_t> counts = {});
    /// Forgets everything. The device must be idle.
    void restart();
    /// What was folded -> film.orders and film.lost.
    void develop(Film& film) const;

    [[nodiscard]] const std::vector<LightBatch>& batches() const { return batches_; }
    /// Of samples folded, per order: what looked for its light.
    [[nodiscard]] const std::vector<std::uint64_t>& rays() const { return rays_; }

private:
    void clear();
    gpu::Device* device_;
    gpu::Image image_;
    uvec2 size_;
    std::uint32_t orders_;
    bool lost_;
    uvec2 grid_;  ///< columns and rows of tiles
    double samples_ = 0.0;
    std::vector<std::vector<glm::dvec3>>
        sums_;  ///< per tile and pixel: means, times the samples they count as
    std::vector<LightBatch> batches_;
    std::vector<std::uint64_t> rays_;
};

}  // namespace licht
