#pragma once
#include <span>
#include <vector>

#include "licht/shared/light.h"

namespace licht {

/// An alias table over non-negative weights: one number picks entry i with probability weights[i] / sum, in
/// constant time. Walker 1974 (New fast method for generating discrete random numbers), in the order of Vose
/// 1991 (A linear algorithm for generating random numbers with a given distribution). `pmf` of each entry is
/// what the table really does. All weights zero, or none: empty.
std::vector<AliasRecord> buildAliasTable(std::span<const double> weights);

}  // namespace licht
