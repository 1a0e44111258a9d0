#include "licht/render/in_flight.h"

#include <fmt/format.h>

#include <cstring>
#include <span>

#include "licht/core/error.h"

namespace licht {

bool lostRays(const CounterRecord& counts) {
    return counts.queue_balance != 0 && counts.truncated_traversals == 0;
}

InFlight::Slot::Slot(gpu::Device& device, const std::string& name)
    : commands(device),
      record(device, "frame " + name, sizeof(FrameRecord), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
             gpu::Memory::host_write),
      counters(device, "counters " + name, sizeof(CounterRecord), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
               gpu::Memory::host_read) {
    std::memset(counters.mapped(), 0, sizeof(CounterRecord));
}

void InFlight::collect(Slot& slot) {
    slot.commands.wait();
    CounterRecord counts;
    std::memcpy(&counts, slot.counters.mapped(), sizeof(counts));
    std::memset(slot.counters.mapped(), 0, sizeof(counts));
    counted_.bounce_rays += counts.bounce_rays;
    counted_.shadow_rays += counts.shadow_rays;
    counted_.nonfinite_samples += counts.nonfinite_samples;
    counted_.truncated_traversals += counts.truncated_traversals;
    counted_.environment_samples += counts.environment_samples;
    counted_.environment_tries += counts.environment_tries;
    lost_ = lost_ || lostRays(counts);
}

std::size_t InFlight::begin(const FrameRecord& record) {
    requireAllTaken();
    const std::size_t slot = next_;
    next_ = (next_ + 1) % kSlots;
    collect(slots_[slot]);
    std::memcpy(slots_[slot].record.mapped(), &record, sizeof(record));
    slots_[slot].commands.begin();
    return slot;
}

void InFlight::submit(std::size_t slot) {
    const gpu::Buffer* counters = &slots_[slot].counters;
    slots_[slot].commands.makeVisibleToHost(std::span(&counters, 1));
    slots_[slot].commands.submit();
}

void InFlight::finish() {
    for (Slot& slot : slots_) collect(slot);
    requireAllTaken();
}

void InFlight::requireAllTaken() const {
    if (lost_)
        throw DeviceError(
            fmt::format("'{}' ({}) lost rays between the kernels that queue and take them; without queues "
                        "(--queues=off) there are none to lose",
                        device_->report().name, device_->report().driver));
}

void InFlight::runAside(gpu::Device& device, const FrameRecord& record,
                        const std::function<void(gpu::Commands&, std::size_t slot)>& work) {
    Slot& slot = slots_[0];
    std::memcpy(slot.record.mapped(), &record, sizeof(record));
    gpu::Commands commands(device);
    commands.begin();
    work(commands, 0);
    commands.submit();
    commands.wait();
    std::memset(slot.counters.mapped(), 0, sizeof(CounterRecord));
}

void InFlight::addTo(RenderStatistics& statistics) const {
    statistics.bounce_rays += counted_.bounce_rays;
    statistics.shadow_rays += counted_.shadow_rays;
    statistics.nonfinite_samples += counted_.nonfinite_samples;
    statistics.truncated_traversals += counted_.truncated_traversals;
    statistics.environment_samples += counted_.environment_samples;
    statistics.environment_tries += counted_.environment_tries;
    for (const Slot& slot : slots_) addTimes(statistics.passes, slot.commands.times());
}

double InFlight::pathSeconds() const {
    double seconds = 0.0;
    for (const Slot& slot : slots_) seconds += licht::pathSeconds(slot.commands.times());
    return seconds;
}

}  // namespace licht
