#pragma once
// What is said of words on the command line that mean nothing.
#include <span>
#include <string>
#include <string_view>

namespace licht {

/// How many letters must be put in, left out, changed or swapped with their neighbour to make one word of the
/// other (optimal string alignment: Damerau 1964, no letter touched twice).
std::size_t editDistance(std::string_view a, std::string_view b);

/// The option that was probably meant: one that begins so, or the nearest within two edits and a third of
/// the letters; empty: none is near.
std::string_view nearestOption(std::string_view word, std::span<const std::string> options);

/// One line. `unknown`: the words that were not understood, in their order; `options`: those that the command
/// has. Values of unknown options are not complained of.
std::string describeUnknown(std::span<const std::string> unknown, std::span<const std::string> options);

}  // namespace licht
