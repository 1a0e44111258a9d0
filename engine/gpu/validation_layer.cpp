#include "validation_layer.h"

#include <fmt/format.h>

#include "licht/core/error.h"
#include "loader.h"

namespace licht::gpu {
namespace {

constexpr const char* kSettingsExtension = "VK_EXT_layer_settings";
constexpr auto kSettingsStructure = static_cast<VkStructureType>(1000496000);
constexpr std::int32_t kBool32 = 0;

}  // namespace

// Layers that have settings leave out what shaders access unless told to look; older ones always look.
ValidationRequest::ValidationRequest(const void* next)
    : shader_accesses_{kValidationLayer, "syncval_shader_accesses_heuristic", kBool32, 1, &on_},
      settings_{kSettingsStructure, next, 1, &shader_accesses_},
      has_settings_(offersExtension(kValidationLayer, kSettingsExtension)) {
    if (!layerInstalled(kValidationLayer)) {
        throw DeviceError(
            fmt::format("the layer {} is not installed; install vulkan-validationlayers", kValidationLayer));
    }
    features_.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features_.pNext = has_settings_ ? &settings_ : next;
    features_.enabledValidationFeatureCount = 1;
    features_.pEnabledValidationFeatures = &synchronisation_;
}

std::vector<const char*> ValidationRequest::extensions() const {
    std::vector<const char*> names{VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    if (has_settings_) {
        names.push_back(kSettingsExtension);
    }
    return names;
}

const void* ValidationRequest::chain() const {
    return &features_;
}

}  // namespace licht::gpu
