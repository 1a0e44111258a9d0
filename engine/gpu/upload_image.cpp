#include "licht/gpu/upload_image.h"

#include <cstring>

#include "licht/gpu/pieces.h"

namespace licht::gpu {

Image uploadImage(Device& device, std::string name, VkExtent2D extent, VkFormat format,
                  std::span<const std::byte> texels, VkImageUsageFlags usage) {
    Image image(device, std::move(name), extent, format, usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    const Buffer staging(device, "staging for " + image.name(), largestPiece(image),
                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Memory::host_write);
    Commands commands(device);
    forEachPiece(image, [&](const VkBufferImageCopy& region, std::size_t first, std::size_t bytes) {
        std::memcpy(staging.mapped(), texels.data() + first, bytes);
        commands.begin();
        commands.pass("upload", {{&staging, Access::transfer_read}, {&image, Access::transfer_write}},
                      [&](VkCommandBuffer recording) {
                          vkCmdCopyBufferToImage(recording, staging.handle(), image.handle(),
                                                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
                      });
        commands.submit();
        commands.wait();
    });
    commands.begin();
    commands.pass("upload", {{&image, Access::compute_sample}}, [](VkCommandBuffer) {});
    commands.submit();
    commands.wait();
    return image;
}

}  // namespace licht::gpu
