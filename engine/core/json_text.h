#pragma once
#include <string>

namespace licht {

/// A document of nlohmann::json as it is written everywhere: indented, a line's end at its end, and valid
/// whatever bytes names have (what is not UTF-8 becomes U+FFFD).
template <typename Json>
std::string jsonText(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace licht
