#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "licht/gpu/device.h"

namespace licht::gpu {

/// What was last done to a resource; Commands derives barriers from it.
struct ResourceState {
    VkPipelineStageFlags2 write_stages = VK_PIPELINE_STAGE_2_NONE;  ///< of the last write or layout change
    VkAccessFlags2 write_access = VK_ACCESS_2_NONE;
    VkPipelineStageFlags2 read_stages = VK_PIPELINE_STAGE_2_NONE;  ///< that have read since
    VkPipelineStageFlags2 seen_stages = VK_PIPELINE_STAGE_2_NONE;  ///< to which the last write is visible
    VkAccessFlags2 seen_access = VK_ACCESS_2_NONE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// What barriers follow a resource by. It stays where it is when its owner is moved, so that views and
/// bindings may point at it.
struct Tracked {
    std::string name;
    VkBuffer buffer = VK_NULL_HANDLE;  ///< either this
    VkImage image = VK_NULL_HANDLE;    ///< or that
    VkImageAspectFlags aspect = 0;     ///< of the image
    ResourceState state;               ///< bookkeeping of Commands
};

/// Bytes of one texel; throws DeviceError for a format that the engine does not use.
std::uint32_t texelBytes(VkFormat format);

enum class Memory {
    device,      ///< device-local
    host_write,  ///< mapped; the host writes, the device reads
    host_read,   ///< mapped, cached where there is such memory; the device writes, the host reads
};

class Buffer {
public:
    Buffer() = default;
    /// size 0 is rounded up to 16 bytes, because Vulkan has no empty buffers.
    Buffer(Device& device, std::string name, VkDeviceSize size, VkBufferUsageFlags usage, Memory memory);
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    ~Buffer();

    [[nodiscard]] VkBuffer handle() const { return tracked_->buffer; }
    [[nodiscard]] VkDeviceSize size() const { return size_; }
    [[nodiscard]] const std::string& name() const { return tracked_->name; }
    [[nodiscard]] std::byte* mapped() const { return mapped_; }  ///< null for Memory::device
    [[nodiscard]] Tracked& tracked() const { return *tracked_; }
    [[nodiscard]] explicit operator bool() const { return tracked_ != nullptr; }

private:
    void destroy() noexcept;
    Device* device_ = nullptr;
    std::unique_ptr<Tracked> tracked_;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkDeviceSize size_ = 0;
    VkDeviceSize allocated_ = 0;
    std::byte* mapped_ = nullptr;
};

/// A device-local buffer filled with these bytes through a staging copy; complete when it returns.
/// VK_BUFFER_USAGE_TRANSFER_DST_BIT is added.
Buffer uploadBuffer(Device& device, std::string name, std::span<const std::byte> bytes,
                    VkBufferUsageFlags usage);

template <typename T>
Buffer uploadBuffer(Device& device, std::string name, std::span<const T> values, VkBufferUsageFlags usage) {
    return uploadBuffer(device, std::move(name), std::as_bytes(values), usage);
}

/// A formatted view on a whole buffer, for uniform texel buffers. The buffer must outlive it, and may move.
class TexelView {
public:
    TexelView() = default;
    TexelView(Device& device, const Buffer& buffer, VkFormat format);
    TexelView(TexelView&& other) noexcept;
    TexelView& operator=(TexelView&& other) noexcept;
    ~TexelView();
    [[nodiscard]] VkBufferView handle() const { return view_; }
    [[nodiscard]] Tracked& tracked() const { return *tracked_; }  ///< the buffer's

private:
    Device* device_ = nullptr;
    Tracked* tracked_ = nullptr;
    VkBufferView view_ = VK_NULL_HANDLE;
};

/// A 2D image of one level, optimal tiling, device-local, with its whole view.
class Image {
public:
    Image() = default;
    Image(Device& device, std::string name, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage);
    Image(Image&& other) noexcept;
    Image& operator=(Image&& other) noexcept;
    ~Image();

    [[nodiscard]] VkImage handle() const { return tracked_->image; }
    [[nodiscard]] VkImageView view() const { return view_; }
    [[nodiscard]] VkExtent2D extent() const { return extent_; }
    [[nodiscard]] VkFormat format() const { return format_; }
    [[nodiscard]] VkImageAspectFlags aspect() const { return tracked_->aspect; }
    [[nodiscard]] const std::string& name() const { return tracked_->name; }
    [[nodiscard]] Tracked& tracked() const { return *tracked_; }
    [[nodiscard]] explicit operator bool() const { return tracked_ != nullptr; }

private:
    void destroy() noexcept;
    Device* device_ = nullptr;
    std::unique_ptr<Tracked> tracked_;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkDeviceSize allocated_ = 0;
    VkImageView view_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    VkFormat format_ = VK_FORMAT_UNDEFINED;
};

class Sampler {
public:
    Sampler() = default;
    Sampler(Device& device, VkFilter filter, VkSamplerAddressMode wrap_u, VkSamplerAddressMode wrap_v);
    Sampler(Sampler&& other) noexcept;
    Sampler& operator=(Sampler&& other) noexcept;
    ~Sampler();
    [[nodiscard]] VkSampler handle() const { return sampler_; }

private:
    Device* device_ = nullptr;
    VkSampler sampler_ = VK_NULL_HANDLE;
};

}  // namespace licht::gpu
