#pragma once
// What can be chosen by name. Each name stands once: for the command line, its help, reports and files.
#include <span>
#include <string_view>

#include "licht/settings/settings.h"

namespace licht {

template <typename Choice>
struct NamedChoice {
    std::string_view name;
    Choice choice;
};

/// All values of Tonemap, QueueUse, BvhQuality, DirectLight, MisHeuristic, LightChoice, EnvironmentSampling
/// or Sequence.
template <typename Choice>
std::span<const NamedChoice<Choice>> choicesOf();

template <typename Choice>
std::string_view nameOf(Choice choice);

}  // namespace licht
