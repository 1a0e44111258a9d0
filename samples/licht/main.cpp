#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>

#include "licht/core/error.h"
#include "samples/licht/command_line.h"
#include "samples/licht/commands.h"
#include "samples/licht/text.h"

namespace {

enum ExitCode { kDone = 0, kFailed = 1, kBadInput = 2 };

struct Run {
    int operator()(const licht::PrintedText& printed) const {
        fmt::print("{}", printed.text);
        return kDone;
    }
    int operator()(const licht::RenderOptions& options) const { return licht::render(options); }
    int operator()(const licht::InfoOptions& options) const { return licht::info(options); }
    int operator()(const licht::BenchOptions& options) const { return licht::bench(options); }
    int operator()(const licht::DevicesOptions& options) const { return licht::devices(options); }
    int operator()(const licht::ViewOptions& options) const { return licht::view(options); }
    int operator()(const licht::CompareOptions& options) const { return licht::compare(options); }
};

int complain(const char* text, ExitCode code) {
    fmt::print(stderr, "licht: {}\n", licht::oneLine(text));
    return code;
}

}  // namespace

int main(int argument_count, char** arguments) {
    try {
        return std::visit(Run{}, licht::parseCommandLine(argument_count, arguments));
    } catch (const licht::InputError& error) {
        return complain(error.what(), kBadInput);
    } catch (const std::bad_alloc&) {
        return complain("out of memory", kFailed);
    } catch (const std::exception& error) {
        return complain(error.what(), kFailed);
    }
}
