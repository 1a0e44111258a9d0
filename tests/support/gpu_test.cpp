#include "support/gpu_test.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <utility>

/// Asked by the leak sanitiser. The validation layer (1.3.239) keeps some of its own records of command
/// buffers for ever.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libVkLayer_khronos_validation\n";
}

namespace licht::gpu {
namespace {

constexpr const char* kSoftwareDevice = "llvmpipe";

struct TestGpu {
    std::unique_ptr<Device> device;
    std::vector<std::string> messages;  ///< not yet reported
};

TestGpu& testGpu() {
    static TestGpu gpu;
    return gpu;
}

std::string wantedDevice() {
    if (const char* wanted = std::getenv("LICHT_TEST_DEVICE"); wanted != nullptr) {
        return wanted;
    }
    const std::vector<DeviceReport> devices = listDevices({});
    const bool software = std::any_of(devices.begin(), devices.end(), [](const DeviceReport& report) {
        return report.refusals.empty() && report.name.find(kSoftwareDevice) != std::string::npos;
    });
    return software ? kSoftwareDevice : "";
}

/// Keeps drivers and layers in memory after the loader has closed them, so that a leak sanitiser can tell
/// whose memory it finds.
void keepLibrariesLoaded() {
    std::vector<std::string> names;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t /*size*/, void* data) {
            static_cast<std::vector<std::string>*>(data)->emplace_back(info->dlpi_name);
            return 0;
        },
        &names);
    for (const std::string& name : names) {
        if (!name.empty()) {
            dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
        }
    }
}

void reportMessages() {
    for (const std::string& message : takeMessages()) {
        ADD_FAILURE() << "validation: " << message;
    }
}

class FailOnMessages : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo& /*info*/) override { reportMessages(); }
};

class DeviceLifetime : public testing::Environment {
public:
    // gtest owns the listener.
    DeviceLifetime() { testing::UnitTest::GetInstance()->listeners().Append(new FailOnMessages); }
    void TearDown() override {
        testGpu().device.reset();
        reportMessages();
    }
};

const testing::Environment* const kRegistered =
    testing::AddGlobalTestEnvironment(new DeviceLifetime);  // gtest owns it

}  // namespace

Device& testDevice() {
    TestGpu& gpu = testGpu();
    if (gpu.device == nullptr) {
        DeviceOptions options;
        options.device = wantedDevice();
        options.validation = true;
        options.on_validation_message = [](const std::string& message) {
            testGpu().messages.push_back(message);
        };
        gpu.device = std::make_unique<Device>(options);
        keepLibrariesLoaded();
    }
    return *gpu.device;
}

std::vector<std::string> takeMessages() {
    return std::exchange(testGpu().messages, {});
}

}  // namespace licht::gpu
