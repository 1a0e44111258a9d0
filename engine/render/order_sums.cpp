#include "licht/render/order_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "licht/gpu/commands.h"
#include "licht/render/tiles.h"
#include "licht/shared/frame.h"

namespace licht {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkImageUsageFlags kUsage =
    VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

// Sums of this many samples in fp32 are right to some 1e-6.
constexpr std::uint32_t kMostSamplesUnfolded = 64;
constexpr std::uint32_t kBatchesPerDoubling = 8;

std::uint32_t tilesOf(std::uint32_t orders, bool lost) {
    return orders + (lost ? 1U : 0U);
}

}  // namespace

OrderSums::OrderSums(gpu::Device& device, uvec2 size, std::uint32_t orders, bool lost)
    : device_(&device),
      size_(size),
      orders_(orders),
      lost_(lost),
      grid_(tileGrid(device, size, tilesOf(orders, lost), "layers of light by bounces",
                     "fewer bounces or a smaller picture")),
      sums_(tilesOf(orders, lost)) {
    // On the device, as sums, and as they are stored.
    constexpr double kBytes = sizeof(vec4) + 2.0 * sizeof(glm::dvec3);
    device.requireMemory(
        kBytes * static_cast<double>(sums_.size()) * size.x * size.y,
        fmt::format("{} layers of light by bounces at {}x{} take", sums_.size(), size.x, size.y));
    image_ = gpu::Image(device, "order_sums", {grid_.x * size.x, grid_.y * size.y}, kFormat, kUsage);
    restart();
}

void OrderSums::restart() {
    for (std::vector<glm::dvec3>& tile : sums_) tile.assign(std::size_t{size_.x} * size_.y, glm::dvec3(0.0));
    samples_ = 0.0;
    batches_.clear();
    rays_.assign(orders_, 0);
    clear();
}

void OrderSums::clear() {
    gpu::Commands commands(*device_);
    commands.begin();
    commands.pass("clear orders", {{&image_, gpu::Access::transfer_write}}, [&](VkCommandBuffer recording) {
        const VkClearColorValue black{};
        const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCmdClearColorImage(recording, image_.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1,
                             &whole);
    });
    commands.submit();
    commands.wait();
}

bool OrderSums::due(std::uint32_t samples, std::uint32_t folded) {
    return samples - folded >= std::clamp(folded / kBatchesPerDoubling, 1U, kMostSamplesUnfolded);
}

void OrderSums::fold(std::uint32_t samples, std::span<const std::uint32_t> counts) {
    assert(counts.empty() || counts.size() == std::size_t{size_.x} * size_.y);
    const std::vector<std::byte> bytes = gpu::readImage(*device_, image_);
    clear();
    const double pixels = static_cast<double>(size_.x) * size_.y;
    LightBatch batch;
    batch.samples = samples;
    batch.orders.resize(orders_);
    for (std::uint32_t tile = 0; tile < sums_.size(); ++tile) {
        const std::size_t first_x = std::size_t{tile % grid_.x} * size_.x;
        const std::size_t first_y = std::size_t{tile / grid_.x} * size_.y;
        glm::dvec3 total(0.0);
        double rays = 0.0;
        for (std::size_t y = 0; y < size_.y; ++y) {
            const std::size_t row = ((first_y + y) * grid_.x * size_.x + first_x) * sizeof(vec4);
            for (std::size_t x = 0; x < size_.x; ++x) {
                vec4 texel;
                std::memcpy(&texel, &bytes[row + x * sizeof(vec4)], sizeof(texel));
                const std::size_t pixel = y * size_.x + x;
                const double share = counts.empty() ? 1.0 : static_cast<double>(samples) / counts[pixel];
                const glm::dvec3 light = glm::dvec3(vec3(texel)) * share;
                sums_[tile][pixel] += light;
                total += light;
                rays += static_cast<double>(texel.w);
            }
        }
        const glm::dvec3 mean = total / (pixels * samples);
        if (lost_ && tile == kLostTile) {
            batch.lost = mean;
        } else {
            const std::uint32_t order = tile - (lost_ ? 1U : 0U);
            batch.orders[order] = mean;
            rays_[order] += static_cast<std::uint64_t>(std::llround(rays));
        }
    }
    samples_ += samples;
    batches_.push_back(std::move(batch));
}

void OrderSums::develop(Film& film) const {
    assert(film.size == size_ && samples_ > 0.0);
    film.orders.clear();
    for (std::uint32_t tile = 0; tile < sums_.size(); ++tile) {
        Image plane(static_cast<int>(size_.x), static_cast<int>(size_.y), 3);
        for (std::size_t pixel = 0; pixel < sums_[tile].size(); ++pixel) {
            const vec3 mean(sums_[tile][pixel] / samples_);
            std::memcpy(&plane.texels[3 * pixel], &mean, sizeof(mean));
        }
        if (lost_ && tile == kLostTile)
            film.lost = std::move(plane);
        else
            film.orders.push_back(std::move(plane));
    }
}

}  // namespace licht
