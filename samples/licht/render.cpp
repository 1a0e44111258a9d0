#include <fmt/format.h>

#include <memory>
#include <optional>

#include "licht/core/clock.h"
#include "licht/oidn/oidn.h"
#include "licht/run/plan.h"
#include "licht/run/render_loop.h"
#include "samples/licht/commands.h"
#include "samples/licht/interrupt.h"
#include "samples/licht/outputs.h"
#include "samples/licht/render_steps.h"
#include "samples/licht/sequence.h"
#include "samples/licht/text.h"

namespace licht {

int render(const RenderOptions& options) {
    if (options.path) return renderSequence(options);
    for (const auto& output : options.outputs) checkWritable(output);
    if (options.report) checkWritable(*options.report);
    if (options.unfiltered) checkWritable(*options.unfiltered);

    const Clock::time_point load_start = Clock::now();
    const NamedScene source = loadScene(options.source);
    const Shot shot = chooseShot(source, options.source.camera, options.size);
    RenderReport report = beginReport(options, source, shot);
    report.load_seconds = secondsSince(load_start);
    requireFilesOfItsOwn(options, source.scene, report.outputs);

    std::optional<ProgressLine> progress(std::in_place, stderr, options.quiet);
    gpu::Device device(deviceOptions(options.device, progress));
    RunSettings run = options.run;
    run.render.size = shot.size;
    const RunPlan plan = planRun(device, source.scene, shot.camera, run);
    notePlan(report, plan);
    const std::unique_ptr<Oidn> oidn = plan.oidn ? makeOidn() : nullptr;
    Renderer renderer(device, source.scene, shot.camera, plan.settings);
    progress->clear();
    if (!options.quiet) {
        warnOfPlan(plan, device.report());
        printWarnings(source.scene);
    }

    InterruptWatch interrupt;
    const LoopHooks hooks{[&interrupt] { return interrupt.asked(); },
                          [&progress](const ProgressState& state) { progress->show(state); }};
    LoopResult result = renderUntil(renderer, plan.settings, plan.rules, hooks);
    if (oidn) filterOnHost(*oidn, result);
    progress.reset();
    interrupt.shield();

    describeRun(report, device, renderer, result);
    const double exposure = options.run.exposure.value_or(source.scene.default_exposure);
    FilesWritten files;
    for (const auto& output : report.outputs) {
        const bool good = writePicture(files, output, renderer, result.film, report, exposure);
        if (good && !options.quiet)
            printOut(fmt::format("wrote {} ({}x{})\n", oneLine(output.string()), shot.size.x, shot.size.y));
    }
    writeUnfiltered(files, options, renderer, exposure);
    report.statistics = renderer.statistics();
    if (!options.quiet) {
        warnOfDoubts(report);
        warnOfBlackness(result.film, exposure);
    }
    writeReport(files, options, report);
    if (!options.quiet) printOut(reportLine(report) + "\n");
    if (result.stopped_by == Stop::interrupt)
        printError(fmt::format("licht: interrupted: wrote what was there, {}\n", reportLine(report)));
    return endRun(files, device);
}

}  // namespace licht
