#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace licht::gpu {

/// What a driver says of itself.
struct DriverFacts {
    VkDriverId id = {};
    std::string info;         ///< "Mesa 25.0.7 (LLVM 19.1.7)"
    std::uint32_t lanes = 0;  ///< of a subgroup
};
DriverFacts driverFacts(VkPhysicalDevice device);

/// Why such a driver must not even be asked (device_check.h), because it would crash or never answer; empty:
/// nothing of the kind is known.
std::vector<std::string> knownFaults(const DriverFacts& driver);

}  // namespace licht::gpu
