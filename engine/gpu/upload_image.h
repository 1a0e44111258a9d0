#pragma once
#include "licht/gpu/commands.h"

namespace licht::gpu {

/// A device-local image filled with these texels (tightly packed, row-major from the top left), ready to be
/// sampled by compute shaders; complete when it returns. VK_IMAGE_USAGE_TRANSFER_DST_BIT is added.
Image uploadImage(Device& device, std::string name, VkExtent2D extent, VkFormat format,
                  std::span<const std::byte> texels, VkImageUsageFlags usage);

}  // namespace licht::gpu
