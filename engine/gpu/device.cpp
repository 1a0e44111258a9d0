#include "licht/gpu/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "device_check.h"
#include "device_select.h"
#include "instance.h"
#include "licht/core/error.h"
#include "licht/core/memory.h"

namespace licht::gpu {
namespace {

bool validationAskedByEnvironment() {
    const char* value = std::getenv("LICHT_VALIDATION");
    return value != nullptr && std::string_view(value) == "1";
}

/// Null where the instance does not have the function.
template <typename Function>
Function instanceFunction(VkInstance instance, const char* name) {
    return std::bit_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

struct Device::Messages {
    std::mutex mutex;
    std::vector<std::string> texts;
    std::function<void(const std::string&)> listener;
    bool print = false;

    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                                  VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user) {
        auto& self = *static_cast<Messages*>(user);
        const std::scoped_lock lock(self.mutex);
        std::string text = data->pMessage;
        // Newer layers leave the rule's name out of the text.
        if (const char* rule = data->pMessageIdName;
            rule != nullptr && text.find(rule) == std::string::npos) {
            text = fmt::format("{}: {}", rule, text);
        }
        self.texts.push_back(std::move(text));
        if (self.listener) {
            self.listener(self.texts.back());
        }
        return VK_FALSE;
    }

    VkDebugUtilsMessengerCreateInfoEXT messengerInfo() {
        VkDebugUtilsMessengerCreateInfoEXT info{};
        info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
        info.messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
        // General messages are the loader's own affairs, such as drivers of other machines that it could not
        // open.
        info.messageType =
            VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
        info.pfnUserCallback = &Messages::receive;
        info.pUserData = this;
        return info;
    }
};

Device::Device() : messages_(std::make_unique<Messages>()) {}

// Delegates, so that the destructor cleans up when a later step throws.
Device::Device(const DeviceOptions& options) : Device() {
    on_compiling_ = options.on_compiling;
    createInstance(options);
    if (options.create_surface) {
        surface_ = options.create_surface(instance_);
    }
    const std::vector<Candidate> candidates = surveyDevices(instance_, surface_);
    const std::optional<std::size_t> chosen = chooseDevice(candidates, options.device);
    if (!chosen && !options.device.empty()) {
        throw InputError(fmt::format("no usable Vulkan device '{}'; there are: {}", options.device,
                                     describeDevices(candidates)));
    }
    if (!chosen) {
        throw DeviceError(fmt::format("no usable Vulkan device: {}", describeDevices(candidates)));
    }
    physical_device_ = candidates[*chosen].device;
    queue_family_ = candidates[*chosen].queue_family;
    report_ = candidates[*chosen].report;
    report_.chosen = true;
    createDevice(surface_ != VK_NULL_HANDLE);
    ballot_trouble_ = checkDevice(*this);
}

void Device::tellCompiling(std::string_view program) {
    ++compiled_programs_;
    if (on_compiling_) on_compiling_(program);
}

void Device::createInstance(const DeviceOptions& options) {
    messages_->print = validationAskedByEnvironment();
    messages_->listener = options.on_validation_message;
    const bool validation = options.validation || messages_->print;
    debug_utils_ = debugUtilsAvailable(validation);
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messages_->messengerInfo();
    instance_ = gpu::createInstance(
        {options.instance_extensions, validation, validation && debug_utils_ ? &messenger : nullptr});
    if (!debug_utils_) {
        return;
    }
    set_name_ = instanceFunction<PFN_vkSetDebugUtilsObjectNameEXT>(instance_, "vkSetDebugUtilsObjectNameEXT");
    begin_label_ =
        instanceFunction<PFN_vkCmdBeginDebugUtilsLabelEXT>(instance_, "vkCmdBeginDebugUtilsLabelEXT");
    end_label_ = instanceFunction<PFN_vkCmdEndDebugUtilsLabelEXT>(instance_, "vkCmdEndDebugUtilsLabelEXT");
    if (validation) {
        const auto create =
            instanceFunction<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT");
        check(create(instance_, &messenger, nullptr, &messenger_), "creating the debug messenger");
    }
}

void Device::createDevice(bool presents) {
    VkPhysicalDeviceMaintenance3Properties largest{};
    largest.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    VkPhysicalDeviceProperties2 asked{};
    asked.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    asked.pNext = &largest;
    vkGetPhysicalDeviceProperties2(physical_device_, &asked);
    const VkPhysicalDeviceProperties& properties = asked.properties;
    limits_ = properties.limits;
    largest_allocation_ = largest.maxMemoryAllocationSize;
    shares_memory_ = properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU &&
                     properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU;
    vkGetPhysicalDeviceMemoryProperties(physical_device_, &memory_properties_);
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical_device_, &count, families.data());
    timestamp_bits_ = families[queue_family_].timestampValidBits;

    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;

    VkPhysicalDeviceVulkan13Features features = neededFeatures();
    const char* swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = presents ? 1 : 0;
    info.ppEnabledExtensionNames = &swapchain;
    check(vkCreateDevice(physical_device_, &info, nullptr, &device_),
          fmt::format("opening the device '{}'", report_.name));
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);

    VkPipelineCacheCreateInfo cache{};
    cache.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    check(vkCreatePipelineCache(device_, &cache, nullptr, &pipeline_cache_), "creating the pipeline cache");
}

Device::~Device() {
    if (given_up_) return;
    if (device_ != VK_NULL_HANDLE) {
        vkDeviceWaitIdle(device_);
        vkDestroyPipelineCache(device_, pipeline_cache_, nullptr);
        vkDestroyDevice(device_, nullptr);
    }
    if (surface_ != VK_NULL_HANDLE) {
        vkDestroySurfaceKHR(instance_, surface_, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
        instanceFunction<PFN_vkDestroyDebugUtilsMessengerEXT>(instance_, "vkDestroyDebugUtilsMessengerEXT")(
            instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        vkDestroyInstance(instance_, nullptr);
    }
    if (messages_->print) {
        for (const std::string& text : messages_->texts) {
            fmt::print(stderr, "validation: {}\n", text);
        }
    }
}

VkDeviceMemory Device::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted,
                                VkMemoryPropertyFlags preferred, std::string_view name) {
    const auto findType = [&](VkMemoryPropertyFlags flags) -> std::optional<std::uint32_t> {
        for (std::uint32_t i = 0; i < memory_properties_.memoryTypeCount; ++i) {
            const bool allowed = (requirements.memoryTypeBits >> i & 1U) != 0;
            if (allowed && (memory_properties_.memoryTypes[i].propertyFlags & flags) == flags) {
                return i;
            }
        }
        return std::nullopt;
    };
    std::optional<std::uint32_t> type = findType(wanted | preferred);
    if (!type) {
        type = findType(wanted);
    }
    if (!type) {
        throw DeviceError(fmt::format("no kind of device memory fits '{}'", name));
    }
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = requirements.size;
    info.memoryTypeIndex = *type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = vkAllocateMemory(device_, &info, nullptr, &memory);
    if (result != VK_SUCCESS) {
        throw DeviceError(fmt::format("'{}' needs {} bytes of device memory, {} are in use: {}", name,
                                      requirements.size, device_bytes_, resultName(result)));
    }
    device_bytes_ += requirements.size;
    device_peak_bytes_ = std::max(device_peak_bytes_, device_bytes_);
    return memory;
}

void Device::requireMemory(double bytes, std::string_view what) const {
    if (shares_memory_) {
        licht::requireMemory(bytes, what);
        return;
    }
    std::uint64_t largest = 0;
    for (std::uint32_t i = 0; i < memory_properties_.memoryHeapCount; ++i)
        if ((memory_properties_.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            largest = std::max<std::uint64_t>(largest, memory_properties_.memoryHeaps[i].size);
    if (bytes + static_cast<double>(device_bytes_) > static_cast<double>(largest))
        throw InputError(fmt::format(
            "{} about {}, and '{}' has {}, of which {} are in use", what, bytesInWords(bytes), report_.name,
            bytesInWords(static_cast<double>(largest)), bytesInWords(static_cast<double>(device_bytes_))));
}

void Device::release(VkDeviceMemory memory, VkDeviceSize size) {
    if (memory != VK_NULL_HANDLE) {
        vkFreeMemory(device_, unlessGivenUp(memory), nullptr);
        device_bytes_ -= size;
    }
}

std::vector<std::string> Device::validationMessages() const {
    const std::scoped_lock lock(messages_->mutex);
    return messages_->texts;
}

void Device::setName(VkObjectType type, std::uint64_t handle, std::string_view name) const {
    if (set_name_ == nullptr) {
        return;
    }
    const std::string text(name);
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = text.c_str();
    check(set_name_(device_, &info), "naming an object");
}

void Device::beginLabel(VkCommandBuffer commands, const char* name) const {
    if (begin_label_ != nullptr) {
        VkDebugUtilsLabelEXT label{};
        label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
        label.pLabelName = name;
        begin_label_(commands, &label);
    }
}

void Device::endLabel(VkCommandBuffer commands) const {
    if (end_label_ != nullptr) {
        end_label_(commands);
    }
}

void Device::waitIdle() const {
    check(vkDeviceWaitIdle(device_), "waiting for the device");
}

}  // namespace licht::gpu
