#pragma once
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace licht::gpu {

/// Throws DeviceError "<what>: VK_ERROR_..." unless the result is VK_SUCCESS. Checked in release builds too.
void check(VkResult result, std::string_view what);
/// "VK_ERROR_DEVICE_LOST" and so on.
std::string_view resultName(VkResult result);

/// One Vulkan device of this machine, and why it would not do.
struct DeviceReport {
    std::uint32_t index = 0;  ///< in the order of enumeration
    std::string name;
    std::string driver;                 ///< driver name and version text
    std::string api_version;            ///< "1.3.230"
    std::string type;                   ///< "cpu", "discrete gpu", "integrated gpu", "virtual gpu", "other"
    std::vector<std::string> refusals;  ///< every reason; empty: usable
    bool chosen = false;
};

struct DeviceOptions {
    std::string device;       ///< name (part of it, case-insensitive) or index; empty: the best usable one
    bool validation = false;  ///< Khronos validation layer with synchronisation validation; throws
                              ///< DeviceError when the layer is missing
    /// Instance extensions that presentation needs (GLFW names them); empty: headless.
    std::vector<std::string> instance_extensions;
    /// Makes the surface that the queue family must be able to present to; called once with the instance.
    /// Null: headless. The device destroys it.
    std::function<VkSurfaceKHR(VkInstance)> create_surface;
    /// Told every validation message at once, also those of the device's own destruction. May be called from
    /// any thread.
    std::function<void(const std::string&)> on_validation_message;
    /// Told every program before it is compiled, which takes minutes with some drivers.
    std::function<void(std::string_view program)> on_compiling;
};

/// Every device with its refusals; `chosen` marks the one that `options` would take. Throws DeviceError when
/// there is no Vulkan loader or driver.
std::vector<DeviceReport> listDevices(const DeviceOptions& options);

/// Instance, device and one queue for graphics, compute and transfer. Vulkan 1.3 core: dynamic rendering,
/// synchronization2 (both required features).
class Device {
public:
    /// Throws InputError when options.device names no usable device (all reasons in the text), DeviceError
    /// when creation fails or when the device computes wrong (device_check.h). LICHT_VALIDATION=1 in the
    /// environment turns validation on as well and prints every message to stderr at destruction.
    explicit Device(const DeviceOptions& options);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device();

    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physicalDevice() const { return physical_device_; }
    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] std::uint32_t queueFamily() const { return queue_family_; }
    [[nodiscard]] VkSurfaceKHR surface() const { return surface_; }
    [[nodiscard]] const DeviceReport& report() const { return report_; }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }
    /// The operation on subgroup ballots that the device gets wrong (device_check.h), so that nothing may use
    /// them; empty: none.
    [[nodiscard]] std::string_view ballotTrouble() const { return ballot_trouble_; }
    [[nodiscard]] VkPipelineCache pipelineCache() const { return pipeline_cache_; }

    /// Memory of that kind for these requirements; counted in deviceBytes(). Throws DeviceError with the size
    /// that did not fit.
    [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& requirements,
                                          VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred,
                                          std::string_view name);
    void release(VkDeviceMemory memory, VkDeviceSize size);
    /// Throws InputError where so many bytes more, on the device, will not do: by licht::requireMemory()
    /// where it shares the host's memory, else by what its largest heap has left.
    void requireMemory(double bytes, std::string_view what) const;
    /// Bytes of one buffer or image at most.
    [[nodiscard]] std::uint64_t largestAllocation() const { return largest_allocation_; }
    /// Bytes of device memory held now, and the most ever held.
    [[nodiscard]] std::uint64_t deviceBytes() const { return device_bytes_; }
    [[nodiscard]] std::uint64_t devicePeakBytes() const { return device_peak_bytes_; }

    /// Programs compiled so far.
    [[nodiscard]] std::uint64_t compiledPrograms() const { return compiled_programs_; }
    /// For Program, before it compiles: counts it and tells DeviceOptions::on_compiling.
    void tellCompiling(std::string_view program);

    /// Validation messages so far (warnings and errors). Tests demand none.
    [[nodiscard]] std::vector<std::string> validationMessages() const;

    /// Names the object for debuggers and validation messages, where debug utils are there.
    void setName(VkObjectType type, std::uint64_t handle, std::string_view name) const;
    [[nodiscard]] bool hasDebugUtils() const { return debug_utils_; }
    /// A named group of commands for debuggers, where debug utils are there.
    void beginLabel(VkCommandBuffer commands, const char* name) const;
    void endLabel(VkCommandBuffer commands) const;
    /// Bits of a timestamp that count; 0: the queue has no timestamps.
    [[nodiscard]] std::uint32_t timestampBits() const { return timestamp_bits_; }

    void waitIdle() const;

    /// A wait was in vain: what the device may still work on is never freed, and no more is waited for it.
    void giveUp() { given_up_ = true; }
    [[nodiscard]] bool givenUp() const { return given_up_; }
    /// What is to be destroyed: the handle, or null, for which Vulkan does nothing.
    template <typename Handle>
    [[nodiscard]] Handle unlessGivenUp(Handle handle) const {
        return given_up_ ? Handle(VK_NULL_HANDLE) : handle;
    }

private:
    struct Messages;
    Device();
    void createInstance(const DeviceOptions& options);
    void createDevice(bool presents);
    bool given_up_ = false;
    std::uint64_t largest_allocation_ = 0;
    bool shares_memory_ = true;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    VkPipelineCache pipeline_cache_ = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits_{};
    VkPhysicalDeviceMemoryProperties memory_properties_{};
    DeviceReport report_;
    std::string_view ballot_trouble_;
    bool debug_utils_ = false;
    std::uint32_t timestamp_bits_ = 0;
    PFN_vkSetDebugUtilsObjectNameEXT set_name_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_label_ = nullptr;
    std::uint64_t device_bytes_ = 0;
    std::uint64_t device_peak_bytes_ = 0;
    std::uint64_t compiled_programs_ = 0;
    std::function<void(std::string_view program)> on_compiling_;
    std::unique_ptr<Messages> messages_;
};

}  // namespace licht::gpu
