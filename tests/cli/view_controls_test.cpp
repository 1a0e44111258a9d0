#include "samples/licht/view_controls.h"

#include <gtest/gtest.h>

#include "licht/settings/settings.h"

namespace licht {
namespace {

ViewState startState() {
    Camera camera;
    camera.world_from_view[3] = vec4(0, 0, 5, 1);
    return {OrbitCamera(camera, Bounds{vec3(-1.0F), vec3(1.0F)}), 0.5, Tonemap::neutral, false};
}

ViewState after(const InputState& input) {
    return applyInput(startState(), startState(), input, 100.0F);
}

ViewState afterKeys(std::vector<int> keys) {
    InputState input;
    input.keys_pressed = std::move(keys);
    return after(input);
}

vec3 eyeOf(const ViewState& state) {
    return vec3(state.orbit.camera().world_from_view[3]);
}

TEST(ViewControls, NothingDoneNothingChanged) {
    const ViewState state = after({});
    EXPECT_EQ(state.orbit.camera().world_from_view, startState().orbit.camera().world_from_view);
    EXPECT_EQ(state.exposure, 0.5);
    EXPECT_EQ(state.tonemap, Tonemap::neutral);
    EXPECT_FALSE(state.quit);
}

TEST(ViewControls, TheSceneFollowsTheHand) {
    InputState input;
    input.orbit = {10.0F, 0.0F};  // to the right: the camera goes to the left
    EXPECT_LT(eyeOf(after(input)).x, 0.0F);
    input = {};
    input.orbit = {0.0F, 10.0F};  // down: the camera rises and looks down
    EXPECT_GT(eyeOf(after(input)).y, 0.0F);
    input = {};
    input.pan = {10.0F, 10.0F};
    EXPECT_LT(eyeOf(after(input)).x, 0.0F);
    EXPECT_GT(eyeOf(after(input)).y, 0.0F);
    input = {};
    input.dolly = 1.0F;
    EXPECT_LT(eyeOf(after(input)).z, 5.0F);
}

TEST(ViewControls, KeysWalkAndResetReturns) {
    EXPECT_LT(eyeOf(afterKeys({'W'})).z, 5.0F);
    EXPECT_GT(eyeOf(afterKeys({'S'})).z, 5.0F);
    EXPECT_GT(eyeOf(afterKeys({'D'})).x, 0.0F);
    EXPECT_LT(eyeOf(afterKeys({'A'})).x, 0.0F);
    EXPECT_EQ(eyeOf(afterKeys({'W', 'D', 'R'})), eyeOf(startState()));
}

TEST(ViewControls, KeysChangeTheDisplay) {
    EXPECT_DOUBLE_EQ(afterKeys({'+'}).exposure, afterKeys({kKeyUp}).exposure);
    EXPECT_GT(afterKeys({'='}).exposure, 0.5);
    EXPECT_LT(afterKeys({'-'}).exposure, 0.5);
    EXPECT_DOUBLE_EQ(afterKeys({'+', '-'}).exposure, 0.5);
    EXPECT_EQ(afterKeys({'T'}).tonemap, Tonemap::agx);
    EXPECT_EQ(afterKeys({'T', 'T', 'T', 'T'}).tonemap, Tonemap::neutral);
    EXPECT_TRUE(afterKeys({kKeyEscape}).quit);
}

}  // namespace
}  // namespace licht
