#pragma once
// Recording and submitting. What a program reads and writes follows from its shaders, attachments and the
// arguments of indirect dispatches from the call; only transfers state it. Barriers, debug labels and timers
// follow from that.
#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "licht/gpu/program.h"

namespace licht::gpu {

/// A program and what the names in its shaders are bound to.
struct BoundProgram {
    const Program& program;
    const Bindings& bindings;
};

struct Threads {
    std::uint32_t x = 1;
    std::uint32_t y = 1;
};

/// A colour image that is cleared to this value before the first draw.
struct ColorTarget {
    const Image* image;
    VkClearColorValue clear{};
};

/// Images to draw into. All are cleared first, depth (may be null) to 0, the farthest.
struct Targets {
    std::span<const ColorTarget> colors;
    const Image* depth = nullptr;
};

/// Seconds on the device per pass name, and how often it ran.
struct PassTime {
    double seconds = 0.0;
    std::uint64_t count = 0;
};

/// Seconds after which a device is taken for hung.
inline constexpr double kLongestWait = 600.0;

/// One command buffer with its fence and timers. Frames in flight are several of these used in turn; they are
/// submitted in the order in which they were recorded, because the state of a resource is followed while
/// recording. The host may write a mapped buffer whenever no submission that uses it is running; that needs
/// no barrier.
class Commands {
public:
    explicit Commands(Device& device);
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;
    ~Commands();

    static constexpr std::uint32_t kMaxPasses = 256;

    /// Starts recording; waits for the last submission of this object first.
    void begin();
    // Each of these records one pass: barriers, a label and a timer called `name`, then what is asked for. At
    // most kMaxPasses between begin() and submit(), else DeviceError. The size of push constants is checked
    // against the shader.

    /// Enough workgroups for that many threads.
    template <typename Push>
    void dispatch(std::string_view name, const BoundProgram& what, const Push& push, Threads threads) {
        dispatchBytes(name, what, std::as_bytes(std::span(&push, 1)), threads);
    }
    void dispatch(std::string_view name, const BoundProgram& what, Threads threads) {
        dispatchBytes(name, what, {}, threads);
    }
    /// As many workgroups as the VkDispatchIndirectCommand at `offset` of `arguments` says.
    template <typename Push>
    void dispatchIndirect(std::string_view name, const BoundProgram& what, const Push& push,
                          const Buffer& arguments, VkDeviceSize offset) {
        dispatchIndirectBytes(name, what, std::as_bytes(std::span(&push, 1)), arguments, offset);
    }
    void dispatchIndirect(std::string_view name, const BoundProgram& what, const Buffer& arguments,
                          VkDeviceSize offset) {
        dispatchIndirectBytes(name, what, {}, arguments, offset);
    }
    /// Draws with the program bound. Viewport and scissor are the whole picture and nothing is culled until
    /// `draws` says otherwise.
    template <typename Push>
    void draw(std::string_view name, const BoundProgram& what, const Push& push, const Targets& targets,
              const std::function<void(VkCommandBuffer)>& draws) {
        drawBytes(name, what, std::as_bytes(std::span(&push, 1)), targets, draws);
    }
    void draw(std::string_view name, const BoundProgram& what, const Targets& targets,
              const std::function<void(VkCommandBuffer)>& draws) {
        drawBytes(name, what, {}, targets, draws);
    }
    /// Anything else, such as transfers, with its uses stated. A resource may stand there several times when
    /// the accesses agree on the image layout.
    void pass(std::string_view name, std::span<const Use> uses,
              const std::function<void(VkCommandBuffer)>& record) {
        recordPass(name, {}, uses, record);
    }
    void pass(std::string_view name, std::initializer_list<Use> uses,
              const std::function<void(VkCommandBuffer)>& record) {
        recordPass(name, {}, std::span(uses.begin(), uses.size()), record);
    }
    /// Makes device writes to host_read buffers visible to the host after wait().
    void makeVisibleToHost(std::span<const Buffer* const> buffers);
    /// Ends recording and submits. The semaphores are for presentation, null otherwise: transfers and colour
    /// output wait for `wait`.
    void submit(VkSemaphore wait = VK_NULL_HANDLE, VkSemaphore signal = VK_NULL_HANDLE);
    /// Blocks until the submission is done; at most `timeout_seconds`, then gives the device up and throws
    /// HungDeviceError. Collects the timers.
    void wait(double timeout_seconds = kLongestWait);
    /// True when nothing submitted is still running.
    [[nodiscard]] bool done() const;

    /// Sums since construction of all finished submissions.
    [[nodiscard]] const std::map<std::string, PassTime>& times() const { return times_; }
    [[nodiscard]] Device& device() const { return device_; }

private:
    void create();
    void destroy() noexcept;
    void recordPass(std::string_view name, std::span<const Use> bound, std::span<const Use> stated,
                    const std::function<void(VkCommandBuffer)>& record);
    void dispatchBytes(std::string_view name, const BoundProgram& what, std::span<const std::byte> push,
                       Threads threads);
    void dispatchIndirectBytes(std::string_view name, const BoundProgram& what,
                               std::span<const std::byte> push, const Buffer& arguments, VkDeviceSize offset);
    void drawBytes(std::string_view name, const BoundProgram& what, std::span<const std::byte> push,
                   const Targets& targets, const std::function<void(VkCommandBuffer)>& draws);
    void bind(const BoundProgram& what, std::span<const std::byte> push) const;
    void barrier(std::span<const Use> bound, std::span<const Use> stated);
    void collectTimes();
    Device& device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer command_buffer_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;  ///< null where the queue has no timestamps
    bool pending_ = false;
    std::vector<std::string> timed_;  ///< pass names of this recording, two queries each
    std::map<std::string, PassTime> times_;
};

/// Copies a whole image (4 bytes or 16 bytes a texel) to host memory. Blocks.
std::vector<std::byte> readImage(Device& device, const Image& image);
/// Copies a whole buffer to host memory. Blocks.
std::vector<std::byte> readBuffer(Device& device, const Buffer& buffer);

}  // namespace licht::gpu
