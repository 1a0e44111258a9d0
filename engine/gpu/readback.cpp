#include <array>

#include "licht/gpu/commands.h"

namespace licht::gpu {
namespace {

using Copy = std::function<void(VkCommandBuffer, VkBuffer)>;

std::vector<std::byte> read(Device& device, VkDeviceSize bytes, const Use& source, const Copy& copy) {
    const Buffer staging(device, "readback", bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, Memory::host_read);
    Commands commands(device);
    commands.begin();
    commands.pass("readback", {source, {&staging, Access::transfer_write}},
                  [&](VkCommandBuffer recording) { copy(recording, staging.handle()); });
    commands.makeVisibleToHost(std::array{&staging});
    commands.submit();
    commands.wait();
    return {staging.mapped(), staging.mapped() + bytes};
}

}  // namespace

std::vector<std::byte> readBuffer(Device& device, const Buffer& buffer) {
    return read(device, buffer.size(), {&buffer, Access::transfer_read},
                [&](VkCommandBuffer commands, VkBuffer staging) {
                    const VkBufferCopy copy{0, 0, buffer.size()};
                    vkCmdCopyBuffer(commands, buffer.handle(), staging, 1, &copy);
                });
}

std::vector<std::byte> readImage(Device& device, const Image& image) {
    const VkExtent2D extent = image.extent();
    const VkDeviceSize bytes = VkDeviceSize{extent.width} * extent.height * texelBytes(image.format());
    return read(device, bytes, {&image, Access::transfer_read},
                [&](VkCommandBuffer commands, VkBuffer staging) {
                    VkBufferImageCopy copy{};
                    copy.imageSubresource = {image.aspect(), 0, 0, 1};
                    copy.imageExtent = {extent.width, extent.height, 1};
                    vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                           staging, 1, &copy);
                });
}

}  // namespace licht::gpu
