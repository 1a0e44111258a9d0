#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "licht/core/one_line.h"

namespace licht {

/// The parts between separators; "" has one empty part.
std::vector<std::string_view> split(std::string_view text, char separator);
/// ASCII letters in lower case.
std::string lowerCase(std::string_view text);

}  // namespace licht
