#include "licht/gpu/upload_image.h"

#include <cstring>

namespace licht::gpu {

Image uploadImage(Device& device, std::string name, VkExtent2D extent, VkFormat format,
                  std::span<const std::byte> texels, VkImageUsageFlags usage) {
    Buffer staging(device, name + " staging", texels.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                   Memory::host_write);
    std::memcpy(staging.mapped(), texels.data(), texels.size());
    Image image(device, std::move(name), extent, format, usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    Commands commands(device);
    commands.begin();
    commands.pass("upload", {{&staging, Access::transfer_read}, {&image, Access::transfer_write}},
                  [&](VkCommandBuffer recording) {
                      VkBufferImageCopy region{};
                      region.imageSubresource = {image.aspect(), 0, 0, 1};
                      region.imageExtent = {extent.width, extent.height, 1};
                      vkCmdCopyBufferToImage(recording, staging.handle(), image.handle(),
                                             VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
                  });
    commands.pass("upload", {{&image, Access::compute_sample}}, [](VkCommandBuffer) {});
    commands.submit();
    commands.wait();
    return image;
}

}  // namespace licht::gpu
