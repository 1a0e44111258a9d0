#pragma once
#include <cstdint>

namespace licht {

/// How many rows of a frame one submission draws, by the seconds that the rows before took; zero: none are
/// done. The picture does not depend on it: a sample is a function of its address alone.
std::uint32_t rowsPerSlice(double seconds, double rows_done, std::uint32_t most_rows);

}  // namespace licht
