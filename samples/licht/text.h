#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace licht {

/// The parts between separators; "" has one empty part.
std::vector<std::string_view> split(std::string_view text, char separator);
/// ASCII letters in lower case.
std::string lowerCase(std::string_view text);
/// The same text without line breaks and control characters, so that a message stays one line whatever was
/// quoted in it.
std::string oneLine(std::string_view text);

}  // namespace licht
