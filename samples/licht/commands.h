#pragma once
// The subcommands. Each throws InputError or DeviceError and returns the exit code otherwise.
#include "samples/licht/options.h"

namespace licht {

int render(const RenderOptions& options);
int view(const ViewOptions& options);
int info(const InfoOptions& options);
int bench(const BenchOptions& options);
int devices(const DevicesOptions& options);
int compare(const CompareOptions& options);
int accuracy(const AccuracyOptions& options);

}  // namespace licht
