#include "licht/run/plan.h"

#include <algorithm>

#include "licht/core/error.h"
#include "licht/gpu/lanes.h"
#include "licht/run/queue_choice.h"

namespace licht {

StopRules stopRules(const RunSettings& run) {
    StopRules rules;
    rules.samples = kMostSamples - run.render.first_sample;
    if (run.samples)
        rules.samples = *run.samples;
    else if (!run.seconds && !run.error)
        rules.samples = kDefaultSamples;
    rules.seconds = run.seconds;
    rules.error = run.error;
    return rules;
}

RunPlan planRun(gpu::Device& device, const Scene& scene, const Camera& camera, const RunSettings& run,
                std::uint32_t pictures) {
    if (run.render.adaptive && run.render.denoise != Denoise::none)
        throw InputError("--denoise filters samples that are as many in every pixel: leave out --adaptive");
    RunPlan plan{run.render, stopRules(run), run.render.denoise == Denoise::oidn, {}, {}, {}};
    if (plan.oidn) {
        plan.settings.denoise = Denoise::none;
        plan.settings.layers.add(LayerId::albedo);
        plan.settings.layers.add(LayerId::normal);
    }
    // Of a still there are no earlier views.
    if (!run.render.moves && run.render.denoise == Denoise::temporal) plan.settings.denoise = Denoise::none;
    plan.settings.blue_bits = blueBitsFor(run.samples);
    if (run.auto_bounces) {
        plan.depth = chooseDepth(device, scene, camera, plan.settings, run.error.value_or(kDefaultTailShare),
                                 mostChosenBounces(run.queues));
        plan.settings.bounces = plan.depth->bounces;
    }
    if (run.render.regularise)
        plan.regularisation = measureRegularisation(device, scene, camera, plan.settings);
    StopRules whole = plan.rules;
    whole.samples = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(std::uint64_t{whole.samples} * pictures, kMostSamples));
    const QueueChoice choice =
        chooseQueues(run.queues, plan.settings, whole,
                     {runsInLockstep(device) && offersBallots(device), device.ballotTrouble()});
    plan.settings.queues = choice.queues;
    plan.queue_trouble = choice.trouble;
    return plan;
}

}  // namespace licht
