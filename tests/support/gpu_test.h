#pragma once
#include <string>
#include <vector>

#include "licht/gpu/device.h"

namespace licht::gpu {

/// The device of this test program, with validation on: what LICHT_TEST_DEVICE names, else lavapipe where it
/// is installed, else the best. Any validation message fails the test during which it came; one that comes
/// when the device goes fails the program.
Device& testDevice();

/// What validation has said to it during this test so far; none of that fails the test.
std::vector<std::string> takeMessages();

}  // namespace licht::gpu
