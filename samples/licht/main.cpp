#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "licht/core/error.h"
#include "samples/licht/command_line.h"
#include "samples/licht/commands.h"
#include "samples/licht/outputs.h"
#include "samples/licht/text.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kBadInput = 2 };

struct Run {
    int operator()(const licht::PrintedText& printed) const {
        licht::printOut(printed.text);
        return kDone;
    }
    int operator()(const licht::RenderOptions& options) const { return licht::render(options); }
    int operator()(const licht::InfoOptions& options) const { return licht::info(options); }
    int operator()(const licht::BenchOptions& options) const { return licht::bench(options); }
    int operator()(const licht::DevicesOptions& options) const { return licht::devices(options); }
    int operator()(const licht::ViewOptions& options) const { return licht::view(options); }
    int operator()(const licht::CompareOptions& options) const { return licht::compare(options); }
    int operator()(const licht::AccuracyOptions& options) const { return licht::accuracy(options); }
};

int complain(const char* text, ExitCode code) {
    licht::printError(fmt::format("licht: {}\n", licht::oneLine(text)));
    return code;
}

/// Of most commands the text is all there is; pictures are there whether or not it was heard of them.
bool worksByText(const licht::Command& command) {
    return !std::holds_alternative<licht::RenderOptions>(command) &&
           !std::holds_alternative<licht::ViewOptions>(command);
}

}  // namespace

int main(int argument_count, char** arguments) {
    try {
        licht::secureStandardStreams();
        const licht::Command command = licht::parseCommandLine(argument_count, arguments);
        const int code = std::visit(Run{}, command);
        if (licht::lostOutput() && worksByText(command))
            return complain("standard output cannot be written to", kFailed);
        return code;
    } catch (const licht::InputError& error) {
        return complain(error.what(), kBadInput);
    } catch (const licht::HungDeviceError& error) {
        // What runs at a usual exit may wait for the device without end.
        const int code = complain(error.what(), kFailed);
        std::fflush(nullptr);
        std::_Exit(code);
    } catch (const std::bad_alloc&) {
        return complain("out of memory", kFailed);
    } catch (const std::exception& error) {
        return complain(error.what(), kFailed);
    }
}
