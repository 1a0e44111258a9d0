#pragma once
// Whether a device computes as the engine depends on. A driver may get one operation wrong and report
// nothing: the picture is black, or a little off. So every device is asked before it draws.
#include <span>
#include <string_view>
#include <vector>

#include "licht/gpu/device.h"
#include "licht/shared/device_check.h"

namespace licht::gpu {

/// What a thread is asked.
CheckQuestion checkQuestion(uint thread);

struct DeviceAnswers {
    std::vector<CheckAnswer> operations;  ///< kCheckThreads
    std::vector<BallotAnswer> ballots;    ///< the same of each round; none where the device has no ballots
};

/// Runs the two programs.
DeviceAnswers askDevice(Device& device);

// The first operation of which an answer is wrong; empty: none. Answers that were not given are wrong.

/// What everything depends on.
std::string_view wrongOperation(std::span<const CheckAnswer> answers);
/// What queues alone depend on.
std::string_view wrongBallotOperation(std::span<const BallotAnswer> answers);

/// Throws DeviceError that names driver and operation where everything depends on it; returns the operation
/// where only queues do, empty where all is right.
std::string_view checkDevice(Device& device);

}  // namespace licht::gpu
