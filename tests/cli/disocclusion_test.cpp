// Two planes that face a camera which steps aside: what comes out from behind the nearer one is a strip whose
// pixels are counted out by hand.
#include "licht/run/disocclusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "licht/render/view.h"
#include "licht/run/recovery.h"

namespace licht {
namespace {

constexpr int kSide = 32;
constexpr float kNear = 2.0F;
constexpr float kFar = 8.0F;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
// On the far plane a pixel is 1/2 m wide, on the near one 1/8 m: pixels move by 1 and by 4.
constexpr float kStep = 0.5F;

ViewRecord viewFrom(const vec3& eye, bool orthographic = false) {
    Camera camera;
    camera.y_fov = 0.5F * kPi;
    camera.kind = orthographic ? Camera::Kind::orthographic : Camera::Kind::perspective;
    camera.y_extent = 8.0F;
    camera.world_from_view[3] = vec4(eye, 1.0F);
    return makeView(camera, uvec2(kSide), {vec3(-10.0F), vec3(10.0F)});
}

/// The nearer plane lies where `axis` (0: x, 1: y) of the world is negative; what is behind it is `far_depth`
/// away.
Image depthsFrom(const vec3& eye, int axis, float far_depth = kFar) {
    Image depth(kSide, kSide, 1);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const float across = (static_cast<float>(x) + 0.5F) / (0.5F * kSide) - 1.0F;
            const float up = 1.0F - (static_cast<float>(y) + 0.5F) / (0.5F * kSide);
            const float place = axis == 0 ? eye.x + kNear * across : eye.y + kNear * up;
            depth.at(x, y, 0) = place < 0.0F ? kNear : far_depth;
        }
    return depth;
}

/// Of the pixels along x or y, with those of the other direction alike.
void expectAlong(const std::vector<std::uint32_t>& found, int axis,
                 const std::function<bool(int)>& expected) {
    ASSERT_EQ(found.size(), static_cast<std::size_t>(kSide * kSide));
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            EXPECT_EQ(found[static_cast<std::size_t>(y * kSide + x)] == kNotSeen, expected(axis == 0 ? x : y))
                << x << " " << y;
}

TEST(Disocclusion, AStepToTheSideUncoversThreePixels) {
    const vec3 aside(kStep, 0.0F, 0.0F);
    const ViewRecord before = viewFrom(vec3(0.0F));
    const ViewRecord now = viewFrom(aside);
    const Image before_depth = depthsFrom(vec3(0.0F), 0);
    const Image now_depth = depthsFrom(aside, 0);
    // The nearer plane ended behind pixel 15 and ends behind 11. Pixel i of the farther one was in i + 1: up
    // to 14 behind the nearer one, and 31 outside the picture.
    expectAlong(findBefore({before, before_depth}, {now, now_depth}), 0,
                [](int i) { return (i >= 12 && i <= 14) || i == 31; });
    // Back again the nearer plane covers more, and uncovers the first column: four pixels of its own.
    expectAlong(findBefore({now, now_depth}, {before, before_depth}), 0, [](int i) { return i <= 3; });
}

TEST(Disocclusion, AStepUpwardUncoversRows) {
    const vec3 above(0.0F, kStep, 0.0F);
    const ViewRecord before = viewFrom(vec3(0.0F));
    const ViewRecord now = viewFrom(above);
    const Image before_depth = depthsFrom(vec3(0.0F), 1);
    const Image now_depth = depthsFrom(above, 1);
    // Rows go down: the nearer plane began at row 16 and begins at 20; row j of the farther one was in j - 1.
    expectAlong(findBefore({before, before_depth}, {now, now_depth}), 1,
                [](int j) { return (j >= 17 && j <= 19) || j == 0; });
}

TEST(Disocclusion, WhatRestsWasSeen) {
    for (const bool orthographic : {false, true}) {
        const ViewRecord view = viewFrom(vec3(0.0F), orthographic);
        const Image depth = depthsFrom(vec3(0.0F), 0);
        expectAlong(findBefore({view, depth}, {view, depth}), 0, [](int) { return false; });
    }
}

TEST(Disocclusion, OrthographicPicturesMoveAsOne) {
    // 16 m wide: a pixel is 1/2 m at any depth, and pixel i was in i + 1.
    const ViewRecord before = viewFrom(vec3(0.0F), true);
    const ViewRecord now = viewFrom(vec3(kStep, 0.0F, 0.0F), true);
    Image depth(kSide, kSide, 1);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) depth.at(x, y, 0) = x < 16 ? kNear : kFar;
    Image moved(kSide, kSide, 1);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) moved.at(x, y, 0) = x < 15 ? kNear : kFar;
    expectAlong(findBefore({before, depth}, {now, moved}), 0, [](int i) { return i == 31; });
    // A hole in the nearer plane: 14 was in 15, where that hid what is behind.
    for (int y = 0; y < kSide; ++y) moved.at(14, y, 0) = kFar;
    expectAlong(findBefore({before, depth}, {now, moved}), 0, [](int i) { return i == 14 || i == 31; });
}

TEST(Disocclusion, TheSkyIsNeverHidden) {
    const vec3 aside(kStep, 0.0F, 0.0F);
    const ViewRecord before = viewFrom(vec3(0.0F));
    const ViewRecord now = viewFrom(aside);
    expectAlong(
        findBefore({before, depthsFrom(vec3(0.0F), 0, kInfinity)}, {now, depthsFrom(aside, 0, kInfinity)}), 0,
        [](int) { return false; });
}

TEST(Disocclusion, ASurfaceAslantIsNotBehindItself) {
    const ViewRecord view = viewFrom(vec3(0.0F));
    Image before(kSide, kSide, 1);
    Image now(kSide, kSide, 1);
    std::fill(now.texels.begin(), now.texels.end(), kFar);
    std::fill(before.texels.begin(), before.texels.end(), 0.99F * kFar);
    expectAlong(findBefore({view, before}, {view, now}), 0, [](int) { return false; });
    std::fill(before.texels.begin(), before.texels.end(), 0.97F * kFar);
    expectAlong(findBefore({view, before}, {view, now}), 0, [](int) { return true; });
}

TEST(Disocclusion, WhatWasBehindTheCameraIsNew) {
    const ViewRecord now = viewFrom(vec3(0.0F));
    const ViewRecord before = viewFrom(vec3(0.0F, 0.0F, -2.0F * kFar));
    Image depth(kSide, kSide, 1);
    std::fill(depth.texels.begin(), depth.texels.end(), kFar);
    expectAlong(findBefore({before, depth}, {now, depth}), 0, [](int) { return true; });
}

TEST(Disocclusion, SurfacesAreFoundWhereTheyLay) {
    const vec3 aside(kStep, 0.0F, 0.0F);
    const ViewRecord before = viewFrom(vec3(0.0F));
    const ViewRecord now = viewFrom(aside);
    const Image before_depth = depthsFrom(vec3(0.0F), 0);
    const Image now_depth = depthsFrom(aside, 0);
    const std::vector<std::uint32_t> places = findBefore({before, before_depth}, {now, now_depth});
    for (std::uint32_t y = 0; y < kSide; ++y) {
        EXPECT_EQ(places[y * kSide + 5], y * kSide + 9) << "four pixels of the nearer plane";
        EXPECT_EQ(places[y * kSide + 20], y * kSide + 21) << "one of the farther";
    }
}

// Two steps to the side and one of rest.
TEST(Recovery, AgesBeginWhereSurfacesComeIntoSight) {
    std::vector<ViewRecord> views;
    std::vector<Image> depths;
    for (const float x : {0.0F, kStep, 2.0F * kStep, 2.0F * kStep}) {
        views.push_back(viewFrom(vec3(x, 0.0F, 0.0F)));
        depths.push_back(depthsFrom(vec3(x, 0.0F, 0.0F), 0));
    }
    SurfaceAges ages;
    ages.advance(std::nullopt, {views[0], depths[0]});
    for (const std::uint32_t age : ages.ages()) ASSERT_EQ(age, SurfaceAges::kUnknown);
    for (std::size_t i = 1; i < views.size(); ++i)
        ages.advance(SeenDepths{views[i - 1], depths[i - 1]}, {views[i], depths[i]});
    // The first step uncovered 12 to 14, which are 11 to 13 after the second, and 31; that uncovered three
    // pixels by the edge that is then at 8, and 31.
    for (std::uint32_t x = 0; x < kSide; ++x) {
        const std::uint32_t expected = (x >= 8 && x <= 10) || x == 31    ? 1U
                                       : (x >= 11 && x <= 13) || x == 30 ? 2U
                                                                         : SurfaceAges::kUnknown;
        EXPECT_EQ(ages.ages()[x], expected) << x;
    }
    ages.advance(std::nullopt, {views[3], depths[3]});
    for (const std::uint32_t age : ages.ages()) ASSERT_EQ(age, SurfaceAges::kUnknown) << "after a cut";
}

TEST(Recovery, IsTheFirstFrameWithinATenthOfAFreshStart) {
    Recovery recovery;
    EXPECT_FALSE(recovery.frames()) << "nothing changed";
    recovery.add(0, {3.0, 1.0, 4});
    EXPECT_FALSE(recovery.frames());
    recovery.add(2, {1.0, 1.0, 4});
    recovery.add(1, {1.2, 1.0, 4});
    EXPECT_EQ(recovery.frames(), 2U);
    recovery.add(1, {0.9, 1.0, 4});  // 2.1 beside 2.0
    EXPECT_EQ(recovery.frames(), 1U);
    Recovery of_nothing;
    of_nothing.add(0, {});
    EXPECT_FALSE(of_nothing.frames()) << "no pixel was touched";
}

TEST(Recovery, HistoriesBeginAnewWithEachChange) {
    FreshStarts starts;
    starts.advance(false, false, false);
    EXPECT_FALSE(starts.watches()) << "nothing changed";
    starts.advance(false, false, true);
    EXPECT_TRUE(starts.begins());
    EXPECT_EQ(starts.kind(), ChangeKind::disocclusion);
    for (std::uint32_t i = 1; i < kWatchedFrames; ++i) {
        starts.advance(false, false, true);
        EXPECT_EQ(starts.framesSince(), i) << "one is watched";
        EXPECT_TRUE(starts.touched(i));
        EXPECT_FALSE(starts.touched(i - 1));
    }
    starts.advance(false, false, false);
    EXPECT_FALSE(starts.watches());
    starts.advance(false, false, true);
    EXPECT_TRUE(starts.begins()) << "what comes into sight later has one, too";
    starts.advance(false, true, false);
    EXPECT_TRUE(starts.begins());
    EXPECT_EQ(starts.kind(), ChangeKind::light);
    EXPECT_TRUE(starts.touched(SurfaceAges::kUnknown)) << "light is everywhere";
    starts.advance(true, true, false);
    EXPECT_TRUE(starts.begins());
    EXPECT_EQ(starts.kind(), ChangeKind::cut);
}

}  // namespace
}  // namespace licht
