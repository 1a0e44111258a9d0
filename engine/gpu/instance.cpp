#include "instance.h"

#include <optional>
#include <vector>

#include "device_select.h"
#include "licht/core/error.h"
#include "loader.h"
#include "validation_layer.h"

namespace licht::gpu {

bool debugUtilsAvailable(bool validation) {
    return offersExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
           (validation && offersExtension(kValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
}

VkInstance createInstance(const InstanceRequest& request) {
    std::vector<const char*> layers;
    std::vector<const char*> extensions;
    for (const std::string& extension : request.extensions) {
        extensions.push_back(extension.c_str());
    }
    if (debugUtilsAvailable(request.validation)) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }

    std::optional<ValidationRequest> validation;
    if (request.validation) {
        validation.emplace(request.messenger);
        layers.push_back(kValidationLayer);
        for (const char* extension : validation->extensions()) {
            extensions.push_back(extension);
        }
    }

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "licht";
    application.pEngineName = "licht";
    application.apiVersion = kApiVersion;

    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = validation ? validation->chain() : request.messenger;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();

    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        throw DeviceError(kNoDriver);
    }
    check(result, "creating the Vulkan instance");
    return instance;
}

}  // namespace licht::gpu
