#include "licht/gpu/lanes.h"

namespace licht {
namespace {

// Fewer give lanes that are done too little to go on with (tests/bench/MEASURED.md, rays). More would leave
// less to every ray of the rounds that some drivers run, and hand out work in larger pieces.
constexpr std::uint32_t kRaysInLockstep = 32;

}  // namespace

bool runsInLockstep(const gpu::Device& device) {
    return device.report().type == "cpu";
}

bool offersBallots(const gpu::Device& device) {
    VkPhysicalDeviceSubgroupProperties subgroups{};
    subgroups.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &subgroups;
    vkGetPhysicalDeviceProperties2(device.physicalDevice(), &properties);
    return (subgroups.supportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT) != 0 &&
           (subgroups.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;
}

bool hasBallots(const gpu::Device& device) {
    return offersBallots(device) && device.ballotTrouble().empty();
}

std::uint32_t raysPerThread(const gpu::Device& device) {
    return runsInLockstep(device) && hasBallots(device) ? kRaysInLockstep : 1;
}

}  // namespace licht
