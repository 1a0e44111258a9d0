#include "loader.h"

#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "device_select.h"

namespace licht::gpu {

bool layerInstalled(const char* layer) {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "listing the Vulkan layers");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "listing the Vulkan layers");
    return std::any_of(layers.begin(), layers.end(), [&](const VkLayerProperties& found) {
        return std::strcmp(found.layerName, layer) == 0;
    });
}

bool offersExtension(const char* layer, const char* extension) {
    std::uint32_t count = 0;
    if (vkEnumerateInstanceExtensionProperties(layer, &count, nullptr) != VK_SUCCESS) {
        return false;
    }
    std::vector<VkExtensionProperties> extensions(count);
    if (vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data()) != VK_SUCCESS) {
        return false;
    }
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& found) {
        return std::strcmp(found.extensionName, extension) == 0;
    });
}

}  // namespace licht::gpu
