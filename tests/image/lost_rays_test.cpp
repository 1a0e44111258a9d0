// Rays that a driver loses between the kernels of the wavefront are no picture but an error.
#include <gtest/gtest.h>

#include <cstring>

#include "licht/core/error.h"
#include "licht/render/in_flight.h"
#include "support/gpu_test.h"

namespace licht {
namespace {

TEST(LostRays, ABalanceThatIsNotZeroIsALoss) {
    CounterRecord counts{};
    EXPECT_FALSE(lostRays(counts));
    counts.queue_balance = 1;
    EXPECT_TRUE(lostRays(counts));
    counts.queue_balance = 0xffffffffU;
    EXPECT_TRUE(lostRays(counts));
    counts.truncated_traversals = 1;
    EXPECT_FALSE(lostRays(counts)) << "truncated traversals leave rays, and are reported as what they are";
}

/// A submission during which nothing but this was counted.
void submit(InFlight& in_flight, std::uint32_t balance) {
    const std::size_t slot = in_flight.begin(FrameRecord{});
    CounterRecord counts{};
    counts.queue_balance = balance;
    std::memcpy(in_flight[slot].counters.mapped(), &counts, sizeof(counts));
    in_flight.submit(slot);
}

TEST(LostRays, AreAnErrorOnceTheSubmissionIsDone) {
    InFlight in_flight(gpu::testDevice());
    submit(in_flight, 0);
    in_flight.finish();
    submit(in_flight, 7);
    EXPECT_THROW(in_flight.finish(), DeviceError);
    EXPECT_THROW(in_flight.begin(FrameRecord{}), DeviceError) << "nor is it forgotten";
}

}  // namespace
}  // namespace licht
