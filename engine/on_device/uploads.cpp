#include "licht/on_device/uploads.h"

#include <fmt/format.h>

#include "licht/core/error.h"
#include "licht/gpu/device.h"

namespace licht {

gpu::Buffer Uploads::buffer(const char* name, std::span<const std::byte> bytes, VkBufferUsageFlags usage) {
    const std::uint64_t limit = device_->limits().maxStorageBufferRange;
    if (usage == VK_BUFFER_USAGE_STORAGE_BUFFER_BIT && bytes.size() > limit)
        throw InputError(
            fmt::format("the scene's {} take {} bytes, and this device's buffers hold at most {}", name,
                        bytes.size(), limit));
    count(bytes.size());
    return gpu::uploadBuffer(*device_, name, bytes, usage);
}

}  // namespace licht
