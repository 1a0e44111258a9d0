#include <fmt/format.h>

#include <algorithm>

#include "licht/core/error.h"
#include "licht/render/renderer.h"
#include "licht/run/accumulation.h"
#include "licht/settings/choices.h"
#include "licht/window/swapchain.h"
#include "licht/window/window.h"
#include "samples/licht/commands.h"
#include "samples/licht/scene_source.h"
#include "samples/licht/view_controls.h"

namespace licht {
namespace {

constexpr double kSecondsBetweenTitles = 0.5;
/// Between looks at a window that cannot be drawn on, or at a picture that is done.
constexpr double kSecondsAsleep = 0.1;

std::string title(const std::string& scene, const Advance& advance, const ViewState& state) {
    std::string text = fmt::format("{} - {} samples, {:.1f} ms each", scene, advance.samples,
                                   1000.0 * advance.seconds / std::max(advance.samples, 1U));
    if (advance.error >= 0.0) text += fmt::format(", error {:.3g}", advance.error);
    return text + fmt::format(" - {}, {:+.2f} EV - Licht", nameOf(state.tonemap), state.exposure);
}

}  // namespace

int view(const ViewOptions& options) {
    if (!Window::available())
        throw InputError("no display to open a window on: use 'licht render' for pictures in files");
    const NamedScene source = loadScene(options.source);
    const Shot shot = chooseShot(source, options.source.camera, options.size);
    printWarnings(source.scene);

    Window window(shot.size, source.name + " - Licht");
    gpu::DeviceOptions device_options;
    device_options.device = options.device;
    window.prepare(device_options);
    gpu::Device device(device_options);
    RenderSettings settings = options.run.render;
    settings.size = shot.size;
    // Without a filter each view begins at the first sample, as the estimate of its error wants.
    settings.moves = settings.denoise != Denoise::none;
    Renderer renderer(device, source.scene, shot.camera, settings);
    Swapchain swapchain(device, window);

    const ViewState start{OrbitCamera(shot.camera, sceneBounds(source.scene)),
                          options.run.exposure.value_or(source.scene.default_exposure), options.run.tonemap};
    ViewState state = start;
    Accumulation accumulation(renderer, settings);
    double titled = 0.0;
    InputState input;
    for (std::uint64_t frame = 0; !window.shouldClose() && (options.frames == 0 || frame < options.frames);
         ++frame) {
        const uvec2 pixels = window.framebufferSize();
        const bool visible = pixels.x > 0 && pixels.y > 0;
        const bool full = renderer.samples() == kMostSamples - settings.first_sample;
        input = visible && !full ? window.poll() : window.waitAndPoll(kSecondsAsleep);
        if (!visible) continue;

        state = applyInput(state, start, input, static_cast<float>(pixels.y));
        if (state.quit) break;
        const std::uint32_t samples_before = renderer.samples();
        if (pixels != settings.size) {
            swapchain.finish();
            renderer.resize(pixels);
            settings.size = pixels;
        }
        renderer.setCamera(state.orbit.camera());
        if (renderer.samples() < samples_before) accumulation.restart();

        if (!full) renderer.renderSample();
        swapchain.present(renderer.displayImage(), [&](gpu::Commands& commands) {
            renderer.recordDisplay(commands, state.tonemap, static_cast<float>(state.exposure));
        });
        const Advance& advance = accumulation.look();
        if (window.seconds() - titled >= kSecondsBetweenTitles) {
            window.setTitle(title(source.name, advance, state));
            titled = window.seconds();
        }
    }
    swapchain.finish();
    renderer.finish();
    return device.validationMessages().empty() ? 0 : 1;
}

}  // namespace licht
