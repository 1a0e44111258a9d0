#include "licht/render/tiles.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/gpu/resource.h"

namespace licht {

uvec2 tileGrid(const gpu::Device& device, uvec2 size, std::uint32_t tiles, std::string_view what,
               std::string_view instead) {
    constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
    constexpr VkImageUsageFlags kUsage =
        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    VkImageFormatProperties limits{};
    gpu::check(vkGetPhysicalDeviceImageFormatProperties(device.physicalDevice(), kFormat, VK_IMAGE_TYPE_2D,
                                                        VK_IMAGE_TILING_OPTIMAL, kUsage, 0, &limits),
               "asking for the largest image");
    const std::uint32_t columns = std::clamp(limits.maxExtent.width / size.x, 1U, tiles);
    const std::uint64_t rows = (std::uint64_t{tiles} + columns - 1) / columns;
    const std::uint64_t bytes = std::uint64_t{columns} * size.x * rows * size.y * gpu::texelBytes(kFormat);
    if (size.x > limits.maxExtent.width || rows * size.y > limits.maxExtent.height ||
        bytes > limits.maxResourceSize)
        throw InputError(fmt::format(
            "{} {} at {}x{} take an image of {}x{} and {:.0f} MiB; that of '{}' ends at "
            "{}x{} and {:.0f} MiB: ask for {}",
            tiles, what, size.x, size.y, std::uint64_t{columns} * size.x, rows * size.y,
            static_cast<double>(bytes) / 1048576.0, device.report().name, limits.maxExtent.width,
            limits.maxExtent.height, static_cast<double>(limits.maxResourceSize) / 1048576.0, instead));
    return {columns, static_cast<std::uint32_t>(rows)};
}

}  // namespace licht
