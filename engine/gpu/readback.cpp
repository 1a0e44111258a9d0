#include <array>
#include <cstring>

#include "licht/gpu/commands.h"
#include "licht/gpu/pieces.h"

namespace licht::gpu {
namespace {

/// Reads one piece after the other through one buffer.
class Readback {
public:
    Readback(Device& device, std::size_t bytes, std::size_t largest_piece)
        : staging_(device, "readback", largest_piece, VK_BUFFER_USAGE_TRANSFER_DST_BIT, Memory::host_read),
          commands_(device),
          bytes_(bytes) {}

    template <typename Copy>
    void piece(const Use& source, std::size_t first, std::size_t bytes, Copy copy) {
        commands_.begin();
        commands_.pass("readback", {source, {&staging_, Access::transfer_write}},
                       [&](VkCommandBuffer recording) { copy(recording, staging_.handle()); });
        commands_.makeVisibleToHost(std::array{&staging_});
        commands_.submit();
        commands_.wait();
        std::memcpy(bytes_.data() + first, staging_.mapped(), bytes);
    }

    std::vector<std::byte> bytes() && { return std::move(bytes_); }

private:
    Buffer staging_;
    Commands commands_;
    std::vector<std::byte> bytes_;
};

}  // namespace

std::vector<std::byte> readBuffer(Device& device, const Buffer& buffer) {
    Readback readback(device, buffer.size(), largestPiece(buffer.size()));
    forEachPiece(buffer.size(), [&](std::size_t first, std::size_t bytes) {
        readback.piece({&buffer, Access::transfer_read}, first, bytes,
                       [&](VkCommandBuffer commands, VkBuffer staging) {
                           const VkBufferCopy copy{first, 0, bytes};
                           vkCmdCopyBuffer(commands, buffer.handle(), staging, 1, &copy);
                       });
    });
    return std::move(readback).bytes();
}

std::vector<std::byte> readImage(Device& device, const Image& image) {
    const VkExtent2D extent = image.extent();
    Readback readback(device, std::size_t{extent.width} * extent.height * texelBytes(image.format()),
                      largestPiece(image));
    forEachPiece(image, [&](const VkBufferImageCopy& region, std::size_t first, std::size_t bytes) {
        readback.piece({&image, Access::transfer_read}, first, bytes,
                       [&](VkCommandBuffer commands, VkBuffer staging) {
                           vkCmdCopyImageToBuffer(commands, image.handle(),
                                                  VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging, 1, &region);
                       });
    });
    return std::move(readback).bytes();
}

}  // namespace licht::gpu
