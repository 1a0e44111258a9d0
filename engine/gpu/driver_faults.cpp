#include "driver_faults.h"

#include <fmt/format.h>

#include <cstdio>

namespace licht::gpu {
namespace {

/// Of "Mesa 25.0.7 ..."; 0 where it is none.
int mesaVersion(const std::string& info) {
    int major = 0;
    return std::sscanf(info.c_str(), "Mesa %d.", &major) == 1 ? major : 0;
}

}  // namespace

DriverFacts driverFacts(VkPhysicalDevice device) {
    VkPhysicalDeviceSubgroupProperties subgroups{};
    subgroups.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    driver.pNext = &subgroups;
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    all.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &all);
    return {driver.driverID, driver.driverInfo, subgroups.subgroupSize};
}

std::vector<std::string> knownFaults(const DriverFacts& driver) {
    std::vector<std::string> faults;
    // Mesa 25.0.7, src/gallium/auxiliary/gallivm/lp_bld_jit_sample.c: widen_to_simd_width() keeps 8 lanes on
    // its stack and writes as many as there are; and what llvmpipe/lp_texture_handle.c keeps in the cache on
    // disk is found again whatever the number of lanes. Mesa 22.3 has neither.
    constexpr std::uint32_t kLanesOfTexelFetches = 8;
    constexpr int kLastSoundMesa = 22;
    if (driver.id == VK_DRIVER_ID_MESA_LLVMPIPE && driver.lanes > kLanesOfTexelFetches &&
        mesaVersion(driver.info) > kLastSoundMesa)
        faults.push_back(fmt::format(
            "with {} lanes this driver fetches wrong texels or crashes; unset LP_NATIVE_VECTOR_WIDTH",
            driver.lanes));
    // Its code generator takes time and memory by more than the length of a program: minutes and gigabytes
    // for the path tracer in one kernel.
    if (driver.id == VK_DRIVER_ID_GOOGLE_SWIFTSHADER)
        faults.emplace_back("SwiftShader does not come to an end with programs as long as the path tracer");
    return faults;
}

}  // namespace licht::gpu
