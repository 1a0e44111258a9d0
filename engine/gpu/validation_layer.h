#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace licht::gpu {

inline constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

/// What the Khronos layer is asked for: synchronisation validation, what shaders access included.
class ValidationRequest {
public:
    /// Throws DeviceError when the layer is not installed. `next` follows in the chain.
    explicit ValidationRequest(const void* next);
    ValidationRequest(const ValidationRequest&) = delete;
    ValidationRequest& operator=(const ValidationRequest&) = delete;

    /// Instance extensions that the layer offers for it.
    [[nodiscard]] std::vector<const char*> extensions() const;
    /// For VkInstanceCreateInfo::pNext while this lives.
    [[nodiscard]] const void* chain() const;

private:
    // VkLayerSettingEXT and VkLayerSettingsCreateInfoEXT, which older headers do not know.
    struct Setting {
        const char* layer;
        const char* name;
        std::int32_t type;
        std::uint32_t count;
        const void* values;
    };
    struct Settings {
        VkStructureType type;
        const void* next;
        std::uint32_t count;
        const Setting* settings;
    };

    VkBool32 on_ = VK_TRUE;
    Setting shader_accesses_;
    Settings settings_;
    VkValidationFeatureEnableEXT synchronisation_ =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features_{};
    bool has_settings_;
};

}  // namespace licht::gpu
