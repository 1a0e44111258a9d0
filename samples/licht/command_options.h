#pragma once
// The options of each subcommand, with their help, as the parser of the command line takes them.
#include <CLI/CLI.hpp>
#include <string>

#include "samples/licht/options.h"

namespace licht {

void addRender(CLI::App& app, RenderOptions& options);
void addView(CLI::App& app, ViewOptions& options);
void addInfo(CLI::App& app, InfoOptions& options);
void addBench(CLI::App& app, BenchOptions& options);
void addDevices(CLI::App& app, DevicesOptions& options);
void addCompare(CLI::App& app, CompareOptions& options);
void addAccuracy(CLI::App& app, AccuracyOptions& options);

/// Of the whole process, so it counts from where it is read.
void addMemoryLimit(CLI::App& app);

}  // namespace licht
