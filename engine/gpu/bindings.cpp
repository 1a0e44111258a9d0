#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "licht/core/error.h"
#include "licht/gpu/program.h"

namespace licht::gpu {
namespace {

/// The descriptor writes of one set; owns what they point at.
class Writes {
public:
    Writes(const Device& device, const Program& program, VkDescriptorSet set)
        : device_(device), program_(program), set_(set) {}

    void add(const ReflectedBinding& binding, std::uint32_t element, const Resource& resource) {
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set_;
        write.dstBinding = binding.binding;
        write.dstArrayElement = element;
        write.descriptorCount = 1;
        write.descriptorType = binding.type;
        switch (binding.type) {
            case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
                write.pBufferInfo = &buffer(binding, resource, device_.limits().maxStorageBufferRange);
                break;
            case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
                write.pBufferInfo = &buffer(binding, resource, device_.limits().maxUniformBufferRange);
                break;
            case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
            case VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER:
                write.pTexelBufferView =
                    &views_.emplace_back(get<const TexelView*>(binding, resource, "a texel view")->handle());
                break;
            case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
                write.pImageInfo = &images_.emplace_back(VkDescriptorImageInfo{
                    VK_NULL_HANDLE, get<const Image*>(binding, resource, "an image")->view(),
                    VK_IMAGE_LAYOUT_GENERAL});
                break;
            case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
                write.pImageInfo = &images_.emplace_back(VkDescriptorImageInfo{
                    VK_NULL_HANDLE, get<const Image*>(binding, resource, "an image")->view(),
                    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
                break;
            case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER: {
                const auto sampled = get<SampledImage>(binding, resource, "an image with its sampler");
                if (sampled.image == nullptr || sampled.sampler == nullptr) {
                    fail(binding, "has no image or no sampler");
                }
                write.pImageInfo = &images_.emplace_back(
                    VkDescriptorImageInfo{sampled.sampler->handle(), sampled.image->view(),
                                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
                break;
            }
            default:
                fail(binding, "is of a kind that Bindings does not know");
        }
        writes_.push_back(write);
    }

    void update() const {
        vkUpdateDescriptorSets(device_.handle(), static_cast<std::uint32_t>(writes_.size()), writes_.data(),
                               0, nullptr);
    }

    [[noreturn]] void fail(const ReflectedBinding& binding, std::string_view reason) const {
        throw DeviceError(fmt::format("'{}': binding '{}' {}", program_.name(), binding.name, reason));
    }

private:
    template <typename Kind>
    Kind get(const ReflectedBinding& binding, const Resource& resource, std::string_view wanted) const {
        const Kind* kind = std::get_if<Kind>(&resource);
        if (kind == nullptr) {
            fail(binding, fmt::format("needs {}", wanted));
        }
        if constexpr (std::is_pointer_v<Kind>) {
            if (*kind == nullptr) {
                fail(binding, "is bound to nothing");
            }
        }
        return *kind;
    }

    const VkDescriptorBufferInfo& buffer(const ReflectedBinding& binding, const Resource& resource,
                                         VkDeviceSize limit) {
        const auto* bound = get<const Buffer*>(binding, resource, "a buffer");
        if (bound->size() > limit) {
            fail(binding, fmt::format("is bound to '{}' of {} bytes, the device allows {}", bound->name(),
                                      bound->size(), limit));
        }
        return buffers_.emplace_back(VkDescriptorBufferInfo{bound->handle(), 0, VK_WHOLE_SIZE});
    }

    const Device& device_;
    const Program& program_;
    VkDescriptorSet set_;
    std::vector<VkWriteDescriptorSet> writes_;
    // Deques, because the writes point at their elements.
    std::deque<VkDescriptorBufferInfo> buffers_;
    std::deque<VkBufferView> views_;
    std::deque<VkDescriptorImageInfo> images_;
};

/// How a pass that runs the program touches what is bound there.
Access accessOf(const ReflectedBinding& binding, const Writes& writes) {
    if ((binding.stages & VK_SHADER_STAGE_COMPUTE_BIT) == 0) {
        if (binding.written || binding.type == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE) {
            writes.fail(binding,
                        "can be written by vertex or fragment shaders, which the engine does not order");
        }
        return Access::raster_read;
    }
    if (binding.type == VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE ||
        binding.type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER) {
        return Access::compute_sample;
    }
    if (!binding.written) {
        return Access::compute_read;
    }
    return binding.read ? Access::compute_read_write : Access::compute_write;
}

Tracked& trackedOf(const Resource& resource) {
    struct Visitor {
        Tracked* operator()(const Buffer* buffer) const { return &buffer->tracked(); }
        Tracked* operator()(const TexelView* view) const { return &view->tracked(); }
        Tracked* operator()(const Image* image) const { return &image->tracked(); }
        Tracked* operator()(const SampledImage& sampled) const { return &sampled.image->tracked(); }
    };
    return *std::visit(Visitor{}, resource);
}

}  // namespace

// Delegates, so that the destructor cleans up when a binding is missing.
Bindings::Bindings(Device& device, const Program& program, std::span<const BoundResource> resources)
    : Bindings() {
    device_ = &device;
    std::map<VkDescriptorType, std::uint32_t> counts;
    for (const ReflectedBinding& binding : program.bindings()) {
        counts[binding.type] += binding.count;
    }
    if (counts.empty()) {
        return;
    }
    std::vector<VkDescriptorPoolSize> sizes;
    for (const auto& [type, count] : counts) {
        sizes.push_back({type, count});
    }
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    check(vkCreateDescriptorPool(device.handle(), &pool, nullptr, &pool_),
          fmt::format("creating the descriptor pool of '{}'", program.name()));

    const VkDescriptorSetLayout layout = program.setLayout();
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = pool_;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    check(vkAllocateDescriptorSets(device.handle(), &allocate, &set_),
          fmt::format("allocating the descriptor set of '{}'", program.name()));

    Writes writes(device, program, set_);
    for (const ReflectedBinding& binding : program.bindings()) {
        std::vector<const Resource*> found;
        for (const BoundResource& bound : resources) {
            if (bound.name == binding.name && found.size() < binding.count) {
                found.push_back(&bound.resource);
            }
        }
        if (found.empty()) {
            writes.fail(binding, "has no resource");
        }
        for (std::uint32_t element = 0; element < binding.count; ++element) {
            writes.add(binding, element, *found[std::min<std::size_t>(element, found.size() - 1)]);
        }
        for (const Resource* resource : found) {
            uses_.emplace_back(trackedOf(*resource), accessOf(binding, writes));
        }
    }
    writes.update();
}

Bindings::Bindings(Bindings&& other) noexcept
    : device_(other.device_),
      pool_(std::exchange(other.pool_, VK_NULL_HANDLE)),
      set_(std::exchange(other.set_, VK_NULL_HANDLE)),
      uses_(std::move(other.uses_)) {}

Bindings& Bindings::operator=(Bindings&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    std::swap(set_, other.set_);
    std::swap(uses_, other.uses_);
    return *this;
}

Bindings::~Bindings() {
    if (pool_ != VK_NULL_HANDLE) {
        vkDestroyDescriptorPool(device_->handle(), device_->unlessGivenUp(pool_), nullptr);
    }
}

}  // namespace licht::gpu
