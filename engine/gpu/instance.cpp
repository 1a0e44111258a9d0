#include "instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "device_select.h"
#include "licht/core/error.h"

namespace licht::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool validationLayerInstalled() {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "listing the Vulkan layers");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "listing the Vulkan layers");
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, kValidationLayer) == 0;
    });
}

/// A null layer asks the loader and its drivers.
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

}  // namespace

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

    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT validation{};
    validation.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    validation.pNext = request.messenger;
    validation.enabledValidationFeatureCount = 1;
    validation.pEnabledValidationFeatures = &synchronization;

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "licht";
    application.pEngineName = "licht";
    application.apiVersion = kApiVersion;

    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = request.messenger;
    info.pApplicationInfo = &application;
    if (request.validation) {
        if (!validationLayerInstalled()) {
            throw DeviceError(fmt::format("the layer {} is not installed; install vulkan-validationlayers",
                                          kValidationLayer));
        }
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        info.pNext = &validation;
    }
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
