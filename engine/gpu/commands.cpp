#include "licht/gpu/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"

namespace licht::gpu {
namespace {

/// The label and the two timestamps around a pass, closed even when recording throws.
class Bracket {
public:
    Bracket(const Device& device, VkCommandBuffer commands, VkQueryPool queries, std::uint32_t pass,
            const std::string& name)
        : device_(device), commands_(commands), queries_(queries), pass_(pass) {
        device_.beginLabel(commands_, name.c_str());
        stamp(2 * pass_);
    }
    Bracket(const Bracket&) = delete;
    Bracket& operator=(const Bracket&) = delete;
    ~Bracket() {
        stamp(2 * pass_ + 1);
        device_.endLabel(commands_);
    }

private:
    void stamp(std::uint32_t query) const {
        if (queries_ != VK_NULL_HANDLE) {
            vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, query);
        }
    }

    const Device& device_;
    VkCommandBuffer commands_;
    VkQueryPool queries_;
    std::uint32_t pass_;
};

std::uint64_t nanoseconds(double seconds) {
    constexpr double kNanoseconds = 1e9;
    return static_cast<std::uint64_t>(std::max(seconds, 0.0) * kNanoseconds);
}

}  // namespace

Commands::Commands(Device& device) : device_(device) {
    // A constructor that throws runs no destructor: the parts are released by hand.
    try {
        create();
    } catch (...) {
        destroy();
        throw;
    }
}

void Commands::create() {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.queueFamilyIndex = device_.queueFamily();
    check(vkCreateCommandPool(device_.handle(), &pool, nullptr, &pool_), "creating a command pool");

    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device_.handle(), &allocate, &command_buffer_),
          "allocating a command buffer");

    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    check(vkCreateFence(device_.handle(), &fence, nullptr, &fence_), "creating a fence");

    if (device_.timestampBits() > 0) {
        VkQueryPoolCreateInfo queries{};
        queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
        queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
        queries.queryCount = 2 * kMaxPasses;
        check(vkCreateQueryPool(device_.handle(), &queries, nullptr, &queries_), "creating the timers");
    }
}

void Commands::destroy() noexcept {
    vkDestroyQueryPool(device_.handle(), device_.unlessGivenUp(queries_), nullptr);
    vkDestroyFence(device_.handle(), device_.unlessGivenUp(fence_), nullptr);
    vkDestroyCommandPool(device_.handle(), device_.unlessGivenUp(pool_), nullptr);
}

Commands::~Commands() {
    // A lost device answers too, and nothing more can be done about it here; one that does not is given up.
    if (pending_ && !device_.givenUp() &&
        vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, nanoseconds(kLongestWait)) == VK_TIMEOUT)
        device_.giveUp();
    destroy();
}

void Commands::begin() {
    wait();
    check(vkResetCommandPool(device_.handle(), pool_, 0), "resetting a command pool");
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(command_buffer_, &info), "starting a command buffer");
    timed_.clear();
    if (queries_ != VK_NULL_HANDLE) {
        vkCmdResetQueryPool(command_buffer_, queries_, 0, 2 * kMaxPasses);
    }
}

void Commands::recordPass(std::string_view name, std::span<const Use> bound, std::span<const Use> stated,
                          const std::function<void(VkCommandBuffer)>& record) {
    if (timed_.size() == kMaxPasses) {
        throw DeviceError(fmt::format("more than {} passes in one recording, at '{}'", kMaxPasses, name));
    }
    timed_.emplace_back(name);
    const Bracket bracket(device_, command_buffer_, queries_, static_cast<std::uint32_t>(timed_.size() - 1),
                          timed_.back());
    barrier(bound, stated);
    record(command_buffer_);
}

void Commands::submit(VkSemaphore wait, VkSemaphore signal) {
    check(vkEndCommandBuffer(command_buffer_), "ending a command buffer");
    VkSemaphoreSubmitInfo wait_info{};
    wait_info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    wait_info.semaphore = wait;
    wait_info.stageMask =
        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    VkSemaphoreSubmitInfo signal_info{};
    signal_info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    signal_info.semaphore = signal;
    signal_info.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkCommandBufferSubmitInfo commands{};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    commands.commandBuffer = command_buffer_;
    VkSubmitInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    info.waitSemaphoreInfoCount = wait != VK_NULL_HANDLE ? 1 : 0;
    info.pWaitSemaphoreInfos = &wait_info;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &commands;
    info.signalSemaphoreInfoCount = signal != VK_NULL_HANDLE ? 1 : 0;
    info.pSignalSemaphoreInfos = &signal_info;
    check(vkQueueSubmit2(device_.queue(), 1, &info, fence_), "submitting work");
    pending_ = true;
}

void Commands::wait(double timeout_seconds) {
    if (!pending_) {
        return;
    }
    const VkResult result = device_.givenUp() ? VK_TIMEOUT
                                              : vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE,
                                                                nanoseconds(timeout_seconds));
    if (result == VK_TIMEOUT) {
        device_.giveUp();
        throw HungDeviceError(fmt::format("the device did not finish within {} seconds", timeout_seconds));
    }
    // A wait that failed is no end of the work: whoever is told of it frees what the work uses.
    if (result != VK_SUCCESS) vkDeviceWaitIdle(device_.handle());
    check(result, "waiting for the device");
    check(vkResetFences(device_.handle(), 1, &fence_), "resetting a fence");
    pending_ = false;
    collectTimes();
}

bool Commands::done() const {
    if (!pending_) {
        return true;
    }
    const VkResult result = vkGetFenceStatus(device_.handle(), fence_);
    if (result == VK_NOT_READY) {
        return false;
    }
    check(result, "asking whether the device is done");
    return true;
}

void Commands::collectTimes() {
    if (queries_ == VK_NULL_HANDLE || timed_.empty()) {
        return;
    }
    std::vector<std::uint64_t> stamps(2 * timed_.size());
    check(vkGetQueryPoolResults(device_.handle(), queries_, 0, static_cast<std::uint32_t>(stamps.size()),
                                stamps.size() * sizeof(stamps[0]), stamps.data(), sizeof(stamps[0]),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "reading the timers");
    const std::uint32_t bits = device_.timestampBits();
    const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    const double seconds_per_tick = static_cast<double>(device_.limits().timestampPeriod) * 1e-9;
    for (std::size_t i = 0; i < timed_.size(); ++i) {
        PassTime& time = times_[timed_[i]];
        // The counter may wrap around between the two.
        time.seconds += static_cast<double>((stamps[2 * i + 1] - stamps[2 * i]) & mask) * seconds_per_tick;
        ++time.count;
    }
}

}  // namespace licht::gpu
