#include "device_select.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

#include "driver_faults.h"
#include "instance.h"
#include "licht/core/error.h"

namespace licht::gpu {
namespace {

/// The least that a device must allow, and what it is for.
struct LimitNeed {
    const char* name;
    std::uint32_t VkPhysicalDeviceLimits::*limit;
    std::uint32_t least;
};
constexpr std::array kLimitNeeds = {
    LimitNeed{"maxPerStageDescriptorStorageBuffers",
              &VkPhysicalDeviceLimits::maxPerStageDescriptorStorageBuffers, 24},
    LimitNeed{"maxPerStageDescriptorSampledImages",
              &VkPhysicalDeviceLimits::maxPerStageDescriptorSampledImages, 16},
    LimitNeed{"maxPerStageDescriptorStorageImages",
              &VkPhysicalDeviceLimits::maxPerStageDescriptorStorageImages, 8},
    LimitNeed{"maxPerStageResources", &VkPhysicalDeviceLimits::maxPerStageResources, 48},
    LimitNeed{"maxStorageBufferRange", &VkPhysicalDeviceLimits::maxStorageBufferRange, 1U << 27U},
    LimitNeed{"maxTexelBufferElements", &VkPhysicalDeviceLimits::maxTexelBufferElements, 1U << 16U},
    LimitNeed{"maxComputeWorkGroupInvocations", &VkPhysicalDeviceLimits::maxComputeWorkGroupInvocations, 64},
    LimitNeed{"maxPushConstantsSize", &VkPhysicalDeviceLimits::maxPushConstantsSize, 128},
    LimitNeed{"maxColorAttachments", &VkPhysicalDeviceLimits::maxColorAttachments, 4},
    LimitNeed{"maxImageDimension2D", &VkPhysicalDeviceLimits::maxImageDimension2D, 4096},
};

struct FeatureNeed {
    const char* name;
    VkBool32 VkPhysicalDeviceVulkan13Features::*feature;
};
constexpr std::array kFeatureNeeds = {
    FeatureNeed{"synchronization2", &VkPhysicalDeviceVulkan13Features::synchronization2},
    FeatureNeed{"dynamicRendering", &VkPhysicalDeviceVulkan13Features::dynamicRendering},
    FeatureNeed{"maintenance4", &VkPhysicalDeviceVulkan13Features::maintenance4},
    // What glslang makes of `discard` for SPIR-V 1.6.
    FeatureNeed{"shaderTerminateInvocation", &VkPhysicalDeviceVulkan13Features::shaderTerminateInvocation},
    FeatureNeed{"shaderDemoteToHelperInvocation",
                &VkPhysicalDeviceVulkan13Features::shaderDemoteToHelperInvocation},
};

const char* typeName(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete gpu";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated gpu";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual gpu";
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "cpu";
        default:
            return "other";
    }
}

/// Greater is better.
int preference(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return 4;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return 3;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return 1;
        default:
            return 0;
    }
}

std::string versionText(std::uint32_t version) {
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return text;
}

bool hasExtension(VkPhysicalDevice device, const char* name) {
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
          "listing device extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()),
          "listing device extensions");
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

/// The first family with graphics and compute (and presentation, where there is a surface), or why there is
/// none.
void chooseQueueFamily(Candidate& candidate, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(candidate.device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(candidate.device, &count, families.data());
    constexpr VkQueueFlags kWork = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    bool works = false;
    for (std::uint32_t family = 0; family < count; ++family) {
        if ((families[family].queueFlags & kWork) != kWork) {
            continue;
        }
        works = true;
        VkBool32 presents = VK_TRUE;
        if (surface != VK_NULL_HANDLE) {
            check(vkGetPhysicalDeviceSurfaceSupportKHR(candidate.device, family, surface, &presents),
                  "asking for presentation support");
        }
        if (presents == VK_TRUE) {
            candidate.queue_family = family;
            return;
        }
    }
    candidate.report.refusals.emplace_back(works ? "no graphics and compute queue can present to this display"
                                                 : "no queue does both graphics and compute");
}

VkPhysicalDeviceVulkan13Features featuresOf(VkPhysicalDevice device) {
    VkPhysicalDeviceVulkan13Features features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    VkPhysicalDeviceFeatures2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    all.pNext = &features;
    vkGetPhysicalDeviceFeatures2(device, &all);
    features.pNext = nullptr;
    return features;
}

std::string driverText(VkPhysicalDevice device) {
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    all.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &all);
    return fmt::format("{} {}", driver.driverName, driver.driverInfo);
}

Candidate survey(VkPhysicalDevice device, std::uint32_t index, VkSurfaceKHR surface) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    Candidate candidate;
    candidate.device = device;
    candidate.type = properties.deviceType;
    DeviceReport& report = candidate.report;
    report.index = index;
    report.name = properties.deviceName;
    report.api_version = versionText(properties.apiVersion);
    report.type = typeName(properties.deviceType);
    // An older device need not know these questions.
    const bool modern = properties.apiVersion >= kApiVersion;
    report.driver = modern ? driverText(device) : versionText(properties.driverVersion);
    report.refusals = refusals(properties, modern ? featuresOf(device) : VkPhysicalDeviceVulkan13Features{});
    if (modern) {
        for (std::string& fault : knownFaults(driverFacts(device)))
            report.refusals.push_back(std::move(fault));
    }
    chooseQueueFamily(candidate, surface);
    if (surface != VK_NULL_HANDLE && !hasExtension(device, VK_KHR_SWAPCHAIN_EXTENSION_NAME)) {
        report.refusals.emplace_back("no VK_KHR_swapchain");
    }
    return candidate;
}

bool selects(const std::string& wanted, const DeviceReport& report) {
    if (wanted.empty()) {
        return true;
    }
    const bool number =
        std::all_of(wanted.begin(), wanted.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    return number ? wanted == std::to_string(report.index)
                  : lower(report.name).find(lower(wanted)) != std::string::npos;
}

}  // namespace

std::vector<std::string> refusals(const VkPhysicalDeviceProperties& properties,
                                  const VkPhysicalDeviceVulkan13Features& features) {
    std::vector<std::string> reasons;
    if (properties.apiVersion < kApiVersion) {
        reasons.push_back(fmt::format("Vulkan {}, {} needed", versionText(properties.apiVersion),
                                      versionText(kApiVersion)));
    }
    for (const FeatureNeed& need : kFeatureNeeds) {
        if (features.*need.feature != VK_TRUE) {
            reasons.push_back(fmt::format("no {}", need.name));
        }
    }
    for (const LimitNeed& need : kLimitNeeds) {
        if (properties.limits.*need.limit < need.least) {
            reasons.push_back(
                fmt::format("{} is {}, {} needed", need.name, properties.limits.*need.limit, need.least));
        }
    }
    return reasons;
}

VkPhysicalDeviceVulkan13Features neededFeatures() {
    VkPhysicalDeviceVulkan13Features features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    for (const FeatureNeed& need : kFeatureNeeds) {
        features.*need.feature = VK_TRUE;
    }
    return features;
}

std::vector<Candidate> surveyDevices(VkInstance instance, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "listing Vulkan devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "listing Vulkan devices");
    if (devices.empty()) {
        throw DeviceError(kNoDriver);
    }
    std::vector<Candidate> candidates;
    for (std::uint32_t i = 0; i < count; ++i) {
        candidates.push_back(survey(devices[i], i, surface));
    }
    return candidates;
}

std::optional<std::size_t> chooseDevice(std::span<const Candidate> candidates, const std::string& wanted) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const Candidate& candidate = candidates[i];
        if (!candidate.report.refusals.empty() || !selects(wanted, candidate.report)) {
            continue;
        }
        if (!best || preference(candidate.type) > preference(candidates[*best].type)) {
            best = i;
        }
    }
    return best;
}

std::string describeDevices(std::span<const Candidate> candidates) {
    std::vector<std::string> lines;
    for (const Candidate& candidate : candidates) {
        const DeviceReport& report = candidate.report;
        lines.push_back(fmt::format("{} '{}' ({})", report.index, report.name,
                                    report.refusals.empty()
                                        ? std::string("usable")
                                        : fmt::format("refused: {}", fmt::join(report.refusals, ", "))));
    }
    return fmt::format("{}", fmt::join(lines, "; "));
}

std::vector<DeviceReport> listDevices(const DeviceOptions& options) {
    struct Session {
        VkInstance instance = VK_NULL_HANDLE;
        VkSurfaceKHR surface = VK_NULL_HANDLE;
        Session() = default;
        Session(const Session&) = delete;
        Session& operator=(const Session&) = delete;
        ~Session() {
            if (surface != VK_NULL_HANDLE) {
                vkDestroySurfaceKHR(instance, surface, nullptr);
            }
            if (instance != VK_NULL_HANDLE) {
                vkDestroyInstance(instance, nullptr);
            }
        }
    } session;
    session.instance = createInstance({options.instance_extensions, false, nullptr});
    if (options.create_surface) {
        session.surface = options.create_surface(session.instance);
    }
    const std::vector<Candidate> candidates = surveyDevices(session.instance, session.surface);
    const std::optional<std::size_t> chosen = chooseDevice(candidates, options.device);
    std::vector<DeviceReport> reports;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        reports.push_back(candidates[i].report);
        reports.back().chosen = chosen == i;
    }
    return reports;
}

}  // namespace licht::gpu
