#pragma once
// Recording and submitting. A pass states what it reads and writes; barriers, debug labels and timers follow
// from that.
#include <functional>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "licht/gpu/program.h"

namespace licht::gpu {

/// How a pass touches a resource. One table (commands.cpp) says which stage, access and image layout each
/// means.
enum class Access {
    compute_read,   ///< storage or uniform buffer, texel buffer; storage image read
    compute_write,  ///< storage, written without being read
    compute_read_write,
    compute_sample,  ///< sampled image
    indirect_read,   ///< VkDispatchIndirectCommand
    raster_read,     ///< buffers in vertex and fragment shaders
    color_target,    ///< cleared or overwritten
    depth_target,
    transfer_read,
    transfer_write,
    present,
};

struct Use {
    std::variant<const Buffer*, const Image*> resource;
    Access access;
};

class Commands;

/// A colour image that is cleared to this value before the first draw.
struct ColorTarget {
    const Image* image;
    VkClearColorValue clear{};
};

/// What a pass may record; valid inside its function alone.
class Pass {
public:
    explicit Pass(Commands& commands) : commands_(commands) {}
    [[nodiscard]] VkCommandBuffer commandBuffer() const;
    /// Binds and dispatches enough workgroups for that many threads. The push constants' size is asserted
    /// against the shader.
    template <typename Push>
    void dispatch(const Program& program, const Bindings& bindings, const Push& push, std::uint32_t threads_x,
                  std::uint32_t threads_y = 1) const {
        dispatchBytes(program, bindings, std::as_bytes(std::span(&push, 1)), threads_x, threads_y);
    }
    /// Dispatches as many workgroups as the VkDispatchIndirectCommand at `offset` says; the pass uses the
    /// buffer as indirect_read.
    template <typename Push>
    void dispatchIndirect(const Program& program, const Bindings& bindings, const Push& constants,
                          const Buffer& buffer, VkDeviceSize offset) const {
        bind(program, bindings);
        push(program, std::as_bytes(std::span(&constants, 1)));
        vkCmdDispatchIndirect(commandBuffer(), buffer.handle(), offset);
    }
    void dispatch(const Program& program, const Bindings& bindings, std::uint32_t threads_x,
                  std::uint32_t threads_y = 1) const {
        dispatchBytes(program, bindings, {}, threads_x, threads_y);
    }
    /// Binds a raster program for draws that follow.
    void bind(const Program& program, const Bindings& bindings) const;
    void push(const Program& program, std::span<const std::byte> bytes) const;
    /// Draws into images that the pass uses as color_target and depth_target. All are cleared first, depth
    /// (may be null) to 0, the farthest. Viewport and scissor are the whole picture and nothing is culled
    /// until `draws` says otherwise.
    void render(std::span<const ColorTarget> colors, const Image* depth,
                const std::function<void()>& draws) const;

private:
    void dispatchBytes(const Program& program, const Bindings& bindings, std::span<const std::byte> push,
                       std::uint32_t threads_x, std::uint32_t threads_y) const;
    Commands& commands_;
};

/// Seconds on the device per pass name, and how often it ran.
struct PassTime {
    double seconds = 0.0;
    std::uint64_t count = 0;
};

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
    /// Records one pass: a barrier for what `uses` states, a label and a timer called `name`, then `record`.
    /// A resource may stand in `uses` several times when the accesses agree on the image layout. At most
    /// kMaxPasses passes between begin() and submit(), else DeviceError.
    void pass(std::string_view name, std::span<const Use> uses,
              const std::function<void(const Pass&)>& record);
    void pass(std::string_view name, std::initializer_list<Use> uses,
              const std::function<void(const Pass&)>& record) {
        pass(name, std::span(uses.begin(), uses.size()), record);
    }
    /// Makes device writes to host_read buffers visible to the host after wait().
    void makeVisibleToHost(std::span<const Buffer* const> buffers);
    /// Ends recording and submits. The semaphores are for presentation, null otherwise: transfers and colour
    /// output wait for `wait`.
    void submit(VkSemaphore wait = VK_NULL_HANDLE, VkSemaphore signal = VK_NULL_HANDLE);
    /// Blocks until the submission is done; at most `timeout_seconds`, then throws DeviceError. Collects the
    /// timers.
    void wait(double timeout_seconds = 600.0);
    /// True when nothing submitted is still running.
    [[nodiscard]] bool done() const;

    /// Sums since construction of all finished submissions.
    [[nodiscard]] const std::map<std::string, PassTime>& times() const { return times_; }
    [[nodiscard]] VkCommandBuffer handle() const { return command_buffer_; }
    [[nodiscard]] Device& device() const { return device_; }

private:
    void create();
    void destroy() noexcept;
    void barrier(std::span<const Use> uses);
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
