#include <fmt/format.h>

#include "licht/core/error.h"
#include "licht/gpu/device.h"

namespace licht::gpu {

std::string_view resultName(VkResult result) {
    switch (result) {
#define LICHT_RESULT(name) \
    case name:             \
        return #name
        LICHT_RESULT(VK_SUCCESS);
        LICHT_RESULT(VK_NOT_READY);
        LICHT_RESULT(VK_TIMEOUT);
        LICHT_RESULT(VK_EVENT_SET);
        LICHT_RESULT(VK_EVENT_RESET);
        LICHT_RESULT(VK_INCOMPLETE);
        LICHT_RESULT(VK_ERROR_OUT_OF_HOST_MEMORY);
        LICHT_RESULT(VK_ERROR_OUT_OF_DEVICE_MEMORY);
        LICHT_RESULT(VK_ERROR_INITIALIZATION_FAILED);
        LICHT_RESULT(VK_ERROR_DEVICE_LOST);
        LICHT_RESULT(VK_ERROR_MEMORY_MAP_FAILED);
        LICHT_RESULT(VK_ERROR_LAYER_NOT_PRESENT);
        LICHT_RESULT(VK_ERROR_EXTENSION_NOT_PRESENT);
        LICHT_RESULT(VK_ERROR_FEATURE_NOT_PRESENT);
        LICHT_RESULT(VK_ERROR_INCOMPATIBLE_DRIVER);
        LICHT_RESULT(VK_ERROR_TOO_MANY_OBJECTS);
        LICHT_RESULT(VK_ERROR_FORMAT_NOT_SUPPORTED);
        LICHT_RESULT(VK_ERROR_FRAGMENTED_POOL);
        LICHT_RESULT(VK_ERROR_OUT_OF_POOL_MEMORY);
        LICHT_RESULT(VK_ERROR_FRAGMENTATION);
        LICHT_RESULT(VK_ERROR_SURFACE_LOST_KHR);
        LICHT_RESULT(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR);
        LICHT_RESULT(VK_SUBOPTIMAL_KHR);
        LICHT_RESULT(VK_ERROR_OUT_OF_DATE_KHR);
#undef LICHT_RESULT
        default:
            return "VK_ERROR_UNKNOWN";
    }
}

void check(VkResult result, std::string_view what) {
    if (result != VK_SUCCESS) {
        throw DeviceError(fmt::format("{}: {}", what, resultName(result)));
    }
}

}  // namespace licht::gpu
