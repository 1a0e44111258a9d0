#pragma once
// How a device is judged and chosen. Shared by listDevices and Device, so that both give the same answer.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "licht/gpu/device.h"

namespace licht::gpu {

inline constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_3;

/// A device with what Device needs to open it.
struct Candidate {
    VkPhysicalDevice device = VK_NULL_HANDLE;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    std::uint32_t queue_family = 0;  ///< meaningful when nothing is refused
    DeviceReport report;
};

/// The features that the engine needs, all of which Vulkan 1.3 guarantees; enabled as they stand.
VkPhysicalDeviceVulkan13Features neededFeatures();

/// Reasons against a device that lie in its version, features and limits; empty when all needs are met.
std::vector<std::string> refusals(const VkPhysicalDeviceProperties& properties,
                                  const VkPhysicalDeviceVulkan13Features& features);

/// Every device of the instance with all reasons against it. A null surface means headless.
std::vector<Candidate> surveyDevices(VkInstance instance, VkSurfaceKHR surface);

/// Position of the device that `wanted` (name, index or empty) selects. Nothing when no usable device fits.
std::optional<std::size_t> chooseDevice(std::span<const Candidate> candidates, const std::string& wanted);

/// "0 'llvmpipe' (usable); 1 'Old' (refused: ..., ...)"
std::string describeDevices(std::span<const Candidate> candidates);

}  // namespace licht::gpu
