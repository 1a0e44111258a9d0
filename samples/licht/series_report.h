#pragma once
// What a report says of the orders of light, of how deep they were followed, and of what shortcuts took.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "samples/licht/report.h"

namespace licht {

/// A list with share, mean, rays and seconds of every order; null where none were kept.
nlohmann::ordered_json ordersJson(const RenderReport& report);
/// What lies beyond the last order; null where that is unknown.
nlohmann::ordered_json tailJson(const RenderReport& report);
/// How --bounces auto chose; null where it did not.
nlohmann::ordered_json depthJson(const RenderReport& report);
/// Every biased shortcut that was on, with the light that it took; null where none was.
nlohmann::ordered_json biasJson(const RenderReport& report);
/// The same in one line; empty where none was.
std::string biasLine(const RenderReport& report);

}  // namespace licht
