#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "licht/gpu/commands.h"
#include "licht/render/pass_list.h"
#include "licht/render/statistics.h"
#include "licht/shared/counters.h"
#include "licht/shared/frame.h"

namespace licht {

/// Whether a submission lost rays between the kernels of the wavefront. Traversals that the driver ended
/// early leave rays of their share untaken, too; those are counted and reported as what they are.
bool lostRays(const CounterRecord& counts);

/// The submissions that run while the host records the next: each has to itself what the host writes and
/// reads.
class InFlight {
public:
    static constexpr std::size_t kSlots = 2;

    struct Slot {
        Slot(gpu::Device& device, const std::string& name);
        gpu::Commands commands;
        gpu::Buffer record;    ///< a FrameRecord
        gpu::Buffer counters;  ///< a CounterRecord
    };

    explicit InFlight(gpu::Device& device) : device_(&device), slots_{Slot(device, "0"), Slot(device, "1")} {}

    [[nodiscard]] const Slot& operator[](std::size_t slot) const { return slots_[slot]; }

    /// Waits for the oldest submission and starts recording in its place. What is counted and timed of it is
    /// in the statistics from then on. Throws DeviceError where rays were lost before.
    std::size_t begin(const FrameRecord& record);
    [[nodiscard]] gpu::Commands& commands(std::size_t slot) { return slots_[slot].commands; }
    void submit(std::size_t slot);
    /// Waits for all. Throws DeviceError where rays were lost.
    void finish();
    /// Records and runs work in the first slot's place while nothing is in flight. It is neither counted nor
    /// timed.
    void runAside(gpu::Device& device, const FrameRecord& record,
                  const std::function<void(gpu::Commands&, std::size_t slot)>& work);

    void addTo(RenderStatistics& statistics) const;
    /// Of the submissions that are done.
    [[nodiscard]] double pathSeconds() const;

private:
    void collect(Slot& slot);
    void requireAllTaken() const;
    const gpu::Device* device_;
    std::array<Slot, kSlots> slots_;
    std::size_t next_ = 0;
    RenderStatistics counted_;
    bool lost_ = false;
};

}  // namespace licht
