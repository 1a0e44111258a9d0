// A Vulkan layer that makes a device fail, for device_faults_test. From the environment:
//   LICHT_FAULTS_LIST=FILE   write down every place that calls, a line each: function and place
//   LICHT_FAULTS_AT=PLACE    the first call from there fails instead of being made
//   LICHT_FAULTS_DEPTH=N     how many functions of the program a place has (2 where it is not said)
//   LICHT_FAULTS_HANG=N      nothing of the Nth submission and of those behind it is ever done
// A place is a function of Vulkan with the innermost functions of the program that called it.
#include <execinfo.h>
#include <link.h>
#include <unistd.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

namespace {

#define LICHT_FAULTY_CALLS(CALL)                                                \
    CALL(vkAllocateCommandBuffers, VK_ERROR_OUT_OF_HOST_MEMORY)                 \
    CALL(vkAllocateDescriptorSets, VK_ERROR_OUT_OF_POOL_MEMORY)                 \
    CALL(vkAllocateMemory, VK_ERROR_OUT_OF_DEVICE_MEMORY)                       \
    CALL(vkBeginCommandBuffer, VK_ERROR_OUT_OF_HOST_MEMORY)                     \
    CALL(vkBindBufferMemory, VK_ERROR_OUT_OF_DEVICE_MEMORY)                     \
    CALL(vkBindImageMemory, VK_ERROR_OUT_OF_DEVICE_MEMORY)                      \
    CALL(vkCreateBuffer, VK_ERROR_OUT_OF_DEVICE_MEMORY)                         \
    CALL(vkCreateBufferView, VK_ERROR_OUT_OF_DEVICE_MEMORY)                     \
    CALL(vkCreateCommandPool, VK_ERROR_OUT_OF_HOST_MEMORY)                      \
    CALL(vkCreateComputePipelines, VK_ERROR_OUT_OF_HOST_MEMORY)                 \
    CALL(vkCreateDescriptorPool, VK_ERROR_OUT_OF_HOST_MEMORY)                   \
    CALL(vkCreateDescriptorSetLayout, VK_ERROR_OUT_OF_HOST_MEMORY)              \
    CALL(vkCreateFence, VK_ERROR_OUT_OF_HOST_MEMORY)                            \
    CALL(vkCreateGraphicsPipelines, VK_ERROR_OUT_OF_HOST_MEMORY)                \
    CALL(vkCreateImage, VK_ERROR_OUT_OF_DEVICE_MEMORY)                          \
    CALL(vkCreateImageView, VK_ERROR_OUT_OF_HOST_MEMORY)                        \
    CALL(vkCreatePipelineCache, VK_ERROR_OUT_OF_HOST_MEMORY)                    \
    CALL(vkCreatePipelineLayout, VK_ERROR_OUT_OF_HOST_MEMORY)                   \
    CALL(vkCreateQueryPool, VK_ERROR_OUT_OF_HOST_MEMORY)                        \
    CALL(vkCreateSampler, VK_ERROR_OUT_OF_HOST_MEMORY)                          \
    CALL(vkCreateShaderModule, VK_ERROR_OUT_OF_HOST_MEMORY)                     \
    CALL(vkDeviceWaitIdle, VK_ERROR_DEVICE_LOST)                                \
    CALL(vkEndCommandBuffer, VK_ERROR_OUT_OF_HOST_MEMORY)                       \
    CALL(vkEnumerateDeviceExtensionProperties, VK_ERROR_OUT_OF_HOST_MEMORY)     \
    CALL(vkEnumeratePhysicalDevices, VK_ERROR_INITIALIZATION_FAILED)            \
    CALL(vkGetFenceStatus, VK_ERROR_DEVICE_LOST)                                \
    CALL(vkGetPhysicalDeviceImageFormatProperties, VK_ERROR_OUT_OF_HOST_MEMORY) \
    CALL(vkGetQueryPoolResults, VK_ERROR_DEVICE_LOST)                           \
    CALL(vkMapMemory, VK_ERROR_MEMORY_MAP_FAILED)                               \
    CALL(vkQueueSubmit2, VK_ERROR_DEVICE_LOST)                                  \
    CALL(vkResetCommandPool, VK_ERROR_OUT_OF_DEVICE_MEMORY)                     \
    CALL(vkResetFences, VK_ERROR_OUT_OF_DEVICE_MEMORY)                          \
    CALL(vkWaitForFences, VK_ERROR_DEVICE_LOST)

enum Index : std::size_t {
#define CALL(name, error) k_##name,
    LICHT_FAULTY_CALLS(CALL)
#undef CALL
        kCount
};
constexpr std::array<const char*, kCount> kNames{
#define CALL(name, error) #name,
    LICHT_FAULTY_CALLS(CALL)
#undef CALL
};
constexpr std::array<VkResult, kCount> kErrors{
#define CALL(name, error) error,
    LICHT_FAULTY_CALLS(CALL)
#undef CALL
};

/// Of the one instance and device that a program of ours makes at a time.
std::array<PFN_vkVoidFunction, kCount> next{};
PFN_vkGetInstanceProcAddr next_of_instance = nullptr;
PFN_vkGetDeviceProcAddr next_of_device = nullptr;

struct Range {
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
};

/// Where the program itself lies in memory.
Range programRange() {
    static const Range range = [] {
        Range found;
        dl_iterate_phdr(
            [](dl_phdr_info* info, std::size_t, void* result) {
                Range& r = *static_cast<Range*>(result);
                r.begin = info->dlpi_addr;
                for (int i = 0; i < info->dlpi_phnum; ++i)
                    if (info->dlpi_phdr[i].p_type == PT_LOAD)
                        r.end = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr + info->dlpi_phdr[i].p_memsz;
                return 1;  // the program comes first
            },
            &found);
        return found;
    }();
    return range;
}

std::string placeOf(const char* function) {
    constexpr int kMostFrames = 24;
    static const char* const depth = std::getenv("LICHT_FAULTS_DEPTH");
    static const int most_kept = depth != nullptr ? std::atoi(depth) : 2;
    std::array<void*, kMostFrames> frames{};
    const int count = backtrace(frames.data(), kMostFrames);
    const Range program = programRange();
    std::string place = function;
    int kept = 0;
    for (int i = 0; i < count && kept < most_kept; ++i) {
        const auto address = reinterpret_cast<std::uintptr_t>(frames.at(static_cast<std::size_t>(i)));
        if (address < program.begin || address >= program.end) continue;
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), ".%zx", static_cast<std::size_t>(address - program.begin));
        place += text.data();
        ++kept;
    }
    return place;
}

bool failsNow(const char* function) {
    static const char* const list = std::getenv("LICHT_FAULTS_LIST");
    static const char* const at = std::getenv("LICHT_FAULTS_AT");
    if (list == nullptr && at == nullptr) return false;
    static std::mutex mutex;
    static std::set<std::string> known;
    const std::string place = placeOf(function);
    const std::lock_guard lock(mutex);
    if (!known.insert(place).second) return false;
    if (list != nullptr)
        if (std::FILE* file = std::fopen(list, "a"); file != nullptr) {
            std::fprintf(file, "%s\n", place.c_str());
            std::fclose(file);
        }
    return at != nullptr && place == at;
}

long firstHung() {
    static const char* const text = std::getenv("LICHT_FAULTS_HANG");
    return text == nullptr ? -1 : std::atol(text);
}
std::atomic<long> submissions{0};
bool hangs() {
    return firstHung() >= 0 && submissions >= firstHung();
}

/// What a device answers that never comes to an end; none: the call is made.
bool hung(Index index, VkResult& result) {
    if (index == k_vkQueueSubmit2 && firstHung() >= 0) {
        result = VK_SUCCESS;
        return ++submissions >= firstHung();
    }
    if (!hangs()) return false;
    if (index == k_vkDeviceWaitIdle)
        for (;;) pause();
    result = index == k_vkWaitForFences ? VK_TIMEOUT : VK_NOT_READY;
    return index == k_vkWaitForFences || index == k_vkGetFenceStatus;
}

template <typename Function>
struct Wrap;
template <typename... Arguments>
struct Wrap<VkResult(VKAPI_PTR*)(Arguments...)> {
    template <Index kIndex>
    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
        if (failsNow(kNames[kIndex])) return kErrors[kIndex];
        if (VkResult result{}; hung(kIndex, result)) return result;
        return reinterpret_cast<VkResult(VKAPI_PTR*)(Arguments...)>(next[kIndex])(arguments...);
    }
};

const std::array<PFN_vkVoidFunction, kCount> kWrappers{
#define CALL(name, error) reinterpret_cast<PFN_vkVoidFunction>(&Wrap<PFN_##name>::call<k_##name>),
    LICHT_FAULTY_CALLS(CALL)
#undef CALL
};

PFN_vkVoidFunction wrapperOf(std::string_view name) {
    for (std::size_t i = 0; i < kCount; ++i)
        if (name == kNames[i]) return kWrappers[i];
    return nullptr;
}

/// The link of the chain that names the next layer, moved on for that layer.
template <typename Link>
Link* linkOf(const void* chain, VkStructureType type) {
    for (auto* link = static_cast<const Link*>(chain); link != nullptr;
         link = static_cast<const Link*>(link->pNext))
        if (link->sType == type && link->function == VK_LAYER_LINK_INFO) return const_cast<Link*>(link);
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocator, VkInstance* instance) {
    auto* link =
        linkOf<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (link == nullptr || failsNow("vkCreateInstance")) return VK_ERROR_INITIALIZATION_FAILED;
    next_of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(next_of_instance(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, instance);
    if (result == VK_SUCCESS)
        for (std::size_t i = 0; i < kCount; ++i) next[i] = next_of_instance(*instance, kNames[i]);
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocator, VkDevice* device) {
    auto* link = linkOf<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (link == nullptr || failsNow("vkCreateDevice")) return VK_ERROR_INITIALIZATION_FAILED;
    const auto of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    next_of_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(of_instance(VK_NULL_HANDLE, "vkCreateDevice"));
    const VkResult result = create(physical, info, allocator, device);
    if (result != VK_SUCCESS) return result;
    for (std::size_t i = 0; i < kCount; ++i)
        if (const auto own = next_of_device(*device, kNames[i]); own != nullptr) next[i] = own;
    return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
    if (std::string_view(name) == "vkGetDeviceProcAddr")
        return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProcAddr);
    const PFN_vkVoidFunction own = next_of_device(device, name);
    const PFN_vkVoidFunction wrapper = wrapperOf(name);
    return own != nullptr && wrapper != nullptr ? wrapper : own;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name) {
    const std::string_view wanted(name);
    if (wanted == "vkGetInstanceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(&getInstanceProcAddr);
    if (wanted == "vkGetDeviceProcAddr") return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProcAddr);
    if (wanted == "vkCreateInstance") return reinterpret_cast<PFN_vkVoidFunction>(&createInstance);
    if (wanted == "vkCreateDevice") return reinterpret_cast<PFN_vkVoidFunction>(&createDevice);
    if (const PFN_vkVoidFunction wrapper = wrapperOf(wanted); wrapper != nullptr) return wrapper;
    return next_of_instance != nullptr ? next_of_instance(instance, name) : nullptr;
}

}  // namespace

extern "C" [[gnu::visibility("default")]] VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* interface) {
    if (interface->loaderLayerInterfaceVersion < 2) return VK_ERROR_INITIALIZATION_FAILED;
    interface->loaderLayerInterfaceVersion = 2;
    interface->pfnGetInstanceProcAddr = &getInstanceProcAddr;
    interface->pfnGetDeviceProcAddr = &getDeviceProcAddr;
    interface->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
