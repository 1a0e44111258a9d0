#pragma once
#include <string>
#include <string_view>

namespace licht {

/// The text as a terminal may show it: on one line and in the order in which it stands there. Control
/// characters (C0, DEL, C1) and what turns the direction of writing (Unicode's bidirectional controls) become
/// spaces, bytes that are no UTF-8 question marks; blanks at the end go. At most `limit` bytes of it, never
/// within a character; what is cut is marked by "...".
std::string oneLine(std::string_view text, std::size_t limit = std::string_view::npos);

}  // namespace licht
