
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "licht/core/error.h"
#include "licht/core/json_text.h"
#include "licht/gpu/device.h"
#include "samples/licht/commands.h"
#include "samples/licht/outputs.h"

namespace licht {
namespace {

std::string devicesJson(const std::vector<gpu::DeviceReport>& reports) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const gpu::DeviceReport& report : reports)
        list.push_back({{"index", report.index},
                        {"name", report.name},
                        {"type", report.type},
                        {"driver", report.driver},
                        {"api_version", report.api_version},
                        {"chosen", report.chosen},
                        {"refusals", report.refusals}});
    return jsonText(list);
}

std::string devicesText(const std::vector<gpu::DeviceReport>& reports) {
    std::string text;
    for (const gpu::DeviceReport& report : reports) {
        const char* verdict = report.chosen ? "chosen" : report.refusals.empty() ? "usable" : "refused";
        text += fmt::format("{}  {}  {}\n   {}, {}, Vulkan {}\n", report.index, report.name, verdict,
                            report.type, report.driver, report.api_version);
        for (const std::string& reason : report.refusals) text += fmt::format("   refused: {}\n", reason);
    }
    return text;
}

}  // namespace

int devices(const DevicesOptions& options) {
    const std::vector<gpu::DeviceReport> reports = gpu::listDevices({});
    printOut(options.json ? devicesJson(reports) : devicesText(reports));
    if (std::none_of(reports.begin(), reports.end(),
                     [](const gpu::DeviceReport& report) { return report.chosen; }))
        throw DeviceError("no usable Vulkan device on this machine");
    return 0;
}

}  // namespace licht
