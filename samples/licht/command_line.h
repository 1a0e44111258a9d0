#pragma once
#include <string>
#include <variant>

#include "samples/licht/options.h"

namespace licht {

/// Text that was asked for instead of work: --help, --version.
struct PrintedText {
    std::string text;
};

using Command = std::variant<PrintedText, RenderOptions, InfoOptions, DevicesOptions, ViewOptions,
                             BenchOptions, CompareOptions, AccuracyOptions>;

/// Throws InputError of one line on wrong usage.
Command parseCommandLine(int argument_count, const char* const* arguments);

}  // namespace licht
