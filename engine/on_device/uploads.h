#pragma once
#include <span>
#include <string>
#include <vector>

#include "licht/gpu/resource.h"

namespace licht {

/// What a buffer of records needs that shaders fetch, see RecordViews.
inline constexpr VkBufferUsageFlags kFetchedUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

/// Brings a scene's values to the device and counts their bytes.
class Uploads {
public:
    explicit Uploads(gpu::Device& device) : device_(&device) {}

    /// Throws InputError, with the numbers, where a storage buffer would be larger than the device's may be.
    template <typename T>
    gpu::Buffer buffer(const char* name, const std::vector<T>& values,
                       VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) {
        return buffer(name, std::as_bytes(std::span(values)), usage);
    }
    /// The same, or no buffer where there are no values.
    template <typename T>
    gpu::Buffer bufferIfAny(const char* name, const std::vector<T>& values,
                            VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) {
        return values.empty() ? gpu::Buffer() : buffer(name, values, usage);
    }
    void count(std::uint64_t bytes) { bytes_ += bytes; }

    [[nodiscard]] gpu::Device& device() const { return *device_; }
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

private:
    gpu::Buffer buffer(const char* name, std::span<const std::byte> bytes, VkBufferUsageFlags usage);

    gpu::Device* device_;
    std::uint64_t bytes_ = 0;
};

}  // namespace licht
