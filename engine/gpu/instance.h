#pragma once
#include <vulkan/vulkan.h>

#include <span>
#include <string>

namespace licht::gpu {

/// Said when the loader knows no driver at all.
inline constexpr const char* kNoDriver =
    "no Vulkan driver found; install mesa-vulkan-drivers or a GPU driver";

/// What an instance is made with.
struct InstanceRequest {
    std::span<const std::string> extensions;
    bool validation = false;
    /// Listener for messages of the instance's own creation and destruction; null: none.
    const VkDebugUtilsMessengerCreateInfoEXT* messenger = nullptr;
};

/// True when the Vulkan loader or the validation layer (where asked for) offers VK_EXT_debug_utils.
bool debugUtilsAvailable(bool validation);

/// Throws DeviceError in plain words when there is no driver, no validation layer, or an extension is
/// missing.
VkInstance createInstance(const InstanceRequest& request);

}  // namespace licht::gpu
