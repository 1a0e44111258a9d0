#include "samples/licht/view_controls.h"

#include <cmath>

#include "licht/settings/choices.h"

namespace licht {
namespace {

constexpr float kRadiansPerHeight = kPi;  ///< a drag over the window's height is half a turn
constexpr float kFactorPerNotch = 0.9F;   ///< of the distance, for a notch of the wheel
constexpr float kStep = 0.1F;             ///< of the distance, for a key
constexpr double kExposureStep = 0.25;    ///< EV

// The plus sign shares its key with = on some keyboards and stands alone on others.
constexpr int kKeypadMinus = 333;
constexpr int kKeypadPlus = 334;

Tonemap next(Tonemap curve) {
    const auto curves = choicesOf<Tonemap>();
    return curves[(static_cast<std::size_t>(curve) + 1) % curves.size()].choice;
}

}  // namespace

ViewState applyInput(ViewState state, const ViewState& start, const InputState& input, float height) {
    if (input.orbit != vec2(0.0F)) {
        const vec2 angle = -kRadiansPerHeight / height * input.orbit;
        state.orbit.orbit(angle.x, angle.y);
    }
    if (input.pan != vec2(0.0F)) state.orbit.pan(input.pan.x / height, -input.pan.y / height);
    if (input.dolly != 0.0F) state.orbit.dolly(std::pow(kFactorPerNotch, input.dolly));
    for (const int key : input.keys_pressed) {
        switch (key) {
            case 'W':
                state.orbit.walk(0.0F, kStep);
                break;
            case 'S':
                state.orbit.walk(0.0F, -kStep);
                break;
            case 'D':
                state.orbit.walk(kStep, 0.0F);
                break;
            case 'A':
                state.orbit.walk(-kStep, 0.0F);
                break;
            case 'R':
                state.orbit = start.orbit;
                break;
            case 'T':
                state.tonemap = next(state.tonemap);
                break;
            case '+':
            case '=':
            case kKeypadPlus:
            case kKeyUp:
                state.exposure += kExposureStep;
                break;
            case '-':
            case kKeypadMinus:
            case kKeyDown:
                state.exposure -= kExposureStep;
                break;
            case kKeyEscape:
                state.quit = true;
                break;
            default:
                break;
        }
    }
    return state;
}

}  // namespace licht
