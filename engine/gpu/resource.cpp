#include "licht/gpu/resource.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <utility>

#include "licht/core/error.h"
#include "licht/gpu/commands.h"
#include "licht/gpu/pieces.h"

namespace licht::gpu {
namespace {

constexpr VkMemoryPropertyFlags kHost =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

struct MemoryFlags {
    VkMemoryPropertyFlags wanted;
    VkMemoryPropertyFlags preferred;
};

MemoryFlags memoryFlags(Memory memory) {
    switch (memory) {
        case Memory::host_write:
            return {kHost, 0};
        case Memory::host_read:
            return {kHost, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
        case Memory::device:
            break;
    }
    return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
}

VkImageAspectFlags aspectOf(VkFormat format) {
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                                           : VK_IMAGE_ASPECT_COLOR_BIT;
}

}  // namespace

std::uint32_t texelBytes(VkFormat format) {
    switch (format) {
        case VK_FORMAT_D16_UNORM:
            return 2;
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_R32_UINT:
        case VK_FORMAT_R32_SINT:
        case VK_FORMAT_D32_SFLOAT:
        case VK_FORMAT_R16G16_SFLOAT:
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_R8G8B8A8_SRGB:
        case VK_FORMAT_B8G8R8A8_UNORM:
            return 4;
        case VK_FORMAT_R32G32_SFLOAT:
        case VK_FORMAT_R32G32_UINT:
        case VK_FORMAT_R16G16B16A16_SFLOAT:
        case VK_FORMAT_R16G16B16A16_UNORM:
            return 8;
        case VK_FORMAT_R32G32B32A32_SFLOAT:
        case VK_FORMAT_R32G32B32A32_UINT:
        case VK_FORMAT_R32G32B32A32_SINT:
            return 16;
        default:
            throw DeviceError(fmt::format("the engine does not use the format {}", static_cast<int>(format)));
    }
}

// The constructors delegate, so that the destructor cleans up when a later step throws.
Buffer::Buffer(Device& device, std::string name, VkDeviceSize size, VkBufferUsageFlags usage, Memory memory)
    : Buffer() {
    constexpr VkDeviceSize kSmallest = 16;  // one texel of the widest format
    device_ = &device;
    tracked_ = std::make_unique<Tracked>();
    tracked_->name = std::move(name);
    size_ = size == 0 ? kSmallest : size;

    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size_;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    check(vkCreateBuffer(device.handle(), &info, nullptr, &tracked_->buffer),
          fmt::format("creating the buffer '{}' of {} bytes", tracked_->name, size_));
    device.setName(VK_OBJECT_TYPE_BUFFER, std::bit_cast<std::uint64_t>(tracked_->buffer), tracked_->name);

    VkMemoryRequirements requirements{};
    vkGetBufferMemoryRequirements(device.handle(), tracked_->buffer, &requirements);
    const MemoryFlags flags = memoryFlags(memory);
    memory_ = device.allocate(requirements, flags.wanted, flags.preferred, tracked_->name);
    allocated_ = requirements.size;
    check(vkBindBufferMemory(device.handle(), tracked_->buffer, memory_, 0),
          fmt::format("binding the buffer '{}'", tracked_->name));
    if (memory != Memory::device) {
        void* address = nullptr;
        check(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &address),
              fmt::format("mapping the buffer '{}'", tracked_->name));
        mapped_ = static_cast<std::byte*>(address);
    }
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    if (this != &other) {
        destroy();
        device_ = other.device_;
        tracked_ = std::move(other.tracked_);
        memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
        size_ = std::exchange(other.size_, 0);
        allocated_ = std::exchange(other.allocated_, 0);
        mapped_ = std::exchange(other.mapped_, nullptr);
    }
    return *this;
}

Buffer::~Buffer() {
    destroy();
}

void Buffer::destroy() noexcept {
    if (tracked_ != nullptr) {
        vkDestroyBuffer(device_->handle(), device_->unlessGivenUp(tracked_->buffer), nullptr);
        device_->release(memory_, allocated_);
    }
}

Buffer uploadBuffer(Device& device, std::string name, std::span<const std::byte> bytes,
                    VkBufferUsageFlags usage) {
    Buffer buffer(device, std::move(name), bytes.size(), usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                  Memory::device);
    if (bytes.empty()) {
        return buffer;
    }
    const Buffer staging(device, "staging for " + buffer.name(), largestPiece(bytes.size()),
                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Memory::host_write);
    Commands commands(device);
    forEachPiece(bytes.size(), [&](std::size_t first, std::size_t count) {
        std::memcpy(staging.mapped(), bytes.data() + first, count);
        commands.begin();
        commands.pass("upload", {{&staging, Access::transfer_read}, {&buffer, Access::transfer_write}},
                      [&](VkCommandBuffer recording) {
                          const VkBufferCopy copy{0, first, count};
                          vkCmdCopyBuffer(recording, staging.handle(), buffer.handle(), 1, &copy);
                      });
        commands.submit();
        commands.wait();
    });
    return buffer;
}

TexelView::TexelView(Device& device, const Buffer& buffer, VkFormat format) : TexelView() {
    device_ = &device;
    tracked_ = &buffer.tracked();
    const VkDeviceSize texels = buffer.size() / texelBytes(format);
    if (texels > device.limits().maxTexelBufferElements) {
        throw DeviceError(fmt::format("the texel buffer '{}' has {} texels, the device allows {}",
                                      buffer.name(), texels, device.limits().maxTexelBufferElements));
    }
    VkBufferViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    info.buffer = buffer.handle();
    info.format = format;
    info.range = texels * texelBytes(format);
    check(vkCreateBufferView(device.handle(), &info, nullptr, &view_),
          fmt::format("creating the texel view of '{}'", buffer.name()));
    device.setName(VK_OBJECT_TYPE_BUFFER_VIEW, std::bit_cast<std::uint64_t>(view_), buffer.name());
}

TexelView::TexelView(TexelView&& other) noexcept
    : device_(other.device_), tracked_(other.tracked_), view_(std::exchange(other.view_, VK_NULL_HANDLE)) {}

TexelView& TexelView::operator=(TexelView&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(tracked_, other.tracked_);
    std::swap(view_, other.view_);
    return *this;
}

TexelView::~TexelView() {
    if (view_ != VK_NULL_HANDLE) {
        vkDestroyBufferView(device_->handle(), device_->unlessGivenUp(view_), nullptr);
    }
}

Image::Image(Device& device, std::string name, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage)
    : Image() {
    device_ = &device;
    tracked_ = std::make_unique<Tracked>();
    tracked_->name = std::move(name);
    tracked_->aspect = aspectOf(format);
    extent_ = extent;
    format_ = format;
    const std::uint32_t longest = device.limits().maxImageDimension2D;
    if (extent.width == 0 || extent.height == 0 || extent.width > longest || extent.height > longest) {
        throw DeviceError(
            fmt::format("the image '{}' of {} x {} pixels does not fit the device, which allows 1 to {}",
                        tracked_->name, extent.width, extent.height, longest));
    }

    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    check(vkCreateImage(device.handle(), &info, nullptr, &tracked_->image),
          fmt::format("creating the image '{}' of {} x {} pixels", tracked_->name, extent.width,
                      extent.height));
    device.setName(VK_OBJECT_TYPE_IMAGE, std::bit_cast<std::uint64_t>(tracked_->image), tracked_->name);

    VkMemoryRequirements requirements{};
    vkGetImageMemoryRequirements(device.handle(), tracked_->image, &requirements);
    const MemoryFlags flags = memoryFlags(Memory::device);
    memory_ = device.allocate(requirements, flags.wanted, flags.preferred, tracked_->name);
    allocated_ = requirements.size;
    check(vkBindImageMemory(device.handle(), tracked_->image, memory_, 0),
          fmt::format("binding the image '{}'", tracked_->name));

    // Transfer alone allows no view.
    constexpr VkImageUsageFlags kViewed = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                          VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if ((usage & kViewed) == 0) {
        return;
    }
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = tracked_->image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {tracked_->aspect, 0, 1, 0, 1};
    check(vkCreateImageView(device.handle(), &view, nullptr, &view_),
          fmt::format("creating the view of '{}'", tracked_->name));
    device.setName(VK_OBJECT_TYPE_IMAGE_VIEW, std::bit_cast<std::uint64_t>(view_), tracked_->name);
}

Image::Image(Image&& other) noexcept {
    *this = std::move(other);
}

Image& Image::operator=(Image&& other) noexcept {
    if (this != &other) {
        destroy();
        device_ = other.device_;
        tracked_ = std::move(other.tracked_);
        memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
        allocated_ = std::exchange(other.allocated_, 0);
        view_ = std::exchange(other.view_, VK_NULL_HANDLE);
        extent_ = other.extent_;
        format_ = other.format_;
    }
    return *this;
}

Image::~Image() {
    destroy();
}

void Image::destroy() noexcept {
    if (tracked_ != nullptr) {
        vkDestroyImageView(device_->handle(), device_->unlessGivenUp(view_), nullptr);
        vkDestroyImage(device_->handle(), device_->unlessGivenUp(tracked_->image), nullptr);
        device_->release(memory_, allocated_);
    }
}

Sampler::Sampler(Device& device, VkFilter filter, VkSamplerAddressMode wrap_u, VkSamplerAddressMode wrap_v)
    : Sampler() {
    device_ = &device;
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = filter;
    info.minFilter = filter;
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = wrap_u;
    info.addressModeV = wrap_v;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    check(vkCreateSampler(device.handle(), &info, nullptr, &sampler_), "creating a sampler");
}

Sampler::Sampler(Sampler&& other) noexcept
    : device_(other.device_), sampler_(std::exchange(other.sampler_, VK_NULL_HANDLE)) {}

Sampler& Sampler::operator=(Sampler&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(sampler_, other.sampler_);
    return *this;
}

Sampler::~Sampler() {
    if (sampler_ != VK_NULL_HANDLE) {
        vkDestroySampler(device_->handle(), device_->unlessGivenUp(sampler_), nullptr);
    }
}

}  // namespace licht::gpu
