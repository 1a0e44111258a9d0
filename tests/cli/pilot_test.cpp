// Small pictures ahead of the one asked for: how deep light is followed, what a shortcut changes.
#include "licht/run/pilot.h"

#include <gtest/gtest.h>

#include "licht/run/plan.h"
#include "licht/settings/settings.h"
#include "samples/scenes/builtin.h"
#include "support/gpu_test.h"

namespace licht {
namespace {

RenderSettings small() {
    RenderSettings settings;
    settings.size = uvec2(16, 12);
    return settings;
}

DepthChoice depthOfFurnace(float albedo, double share, std::uint32_t most = kMostAutoBounces) {
    Scene scene = *makeBuiltinScene("furnace");
    scene.materials[0].base_color = vec4(vec3(albedo), 1.0F);
    return chooseDepth(gpu::testDevice(), scene, scene.cameras[0], small(), share, most);
}

// What is left after n bounces is r^(n+1): one per cent after 6, 20 and 43 at albedo 0.5, 0.8 and 0.9.
TEST(Depth, OfAFurnaceFollowsFromItsClosedForm) {
    EXPECT_EQ(depthOfFurnace(0.5F, 0.01).bounces, 6U);
    EXPECT_EQ(depthOfFurnace(0.5F, 0.3).bounces, 1U);
    EXPECT_EQ(depthOfFurnace(0.8F, 0.01).bounces, 20U);
    const DepthChoice deep = depthOfFurnace(0.9F, 0.01);
    EXPECT_EQ(deep.bounces, 43U);
    EXPECT_TRUE(deep.reached);
    EXPECT_EQ(deep.pilot_bounces, kMostAutoBounces) << "the first look was not deep enough";
    ASSERT_TRUE(deep.tail);
    EXPECT_NEAR(deep.tail->share.value, 0.0097, 1e-4);
}

TEST(Depth, OfAlbedoOneEndsAtTheLimit) {
    const DepthChoice depth = depthOfFurnace(1.0F, 0.01, 40);
    EXPECT_EQ(depth.bounces, 40U);
    EXPECT_FALSE(depth.reached);
}

TEST(Depth, DoesNotDependOnThePicturesOwnChoices) {
    const Scene scene = *makeBuiltinScene("cornell");
    RenderSettings settings = small();
    const DepthChoice plain = chooseDepth(gpu::testDevice(), scene, scene.cameras[0], settings, 0.01, 64);
    settings.clamp = 0.01F;
    settings.adaptive = true;
    settings.queues = true;
    settings.sampler = Sequence::blue;
    const DepthChoice other = chooseDepth(gpu::testDevice(), scene, scene.cameras[0], settings, 0.01, 64);
    EXPECT_EQ(plain.bounces, other.bounces);
    ASSERT_TRUE(plain.tail && other.tail);
    EXPECT_EQ(plain.tail->share.value, other.tail->share.value);
    EXPECT_GE(plain.bounces, 3U);
    EXPECT_LE(plain.bounces, 12U);
}

TEST(Regularisation, IsMeasuredOnPairs) {
    const Scene cornell = *makeBuiltinScene("cornell");
    const BiasMeasure nothing =
        measureRegularisation(gpu::testDevice(), cornell, cornell.cameras[0], small());
    EXPECT_EQ(nothing.change.value, 0.0) << "nothing is glossy";
    EXPECT_EQ(nothing.change.standard_error, 0.0);
    const Scene gallery = *makeBuiltinScene("gallery");
    RenderSettings settings = small();
    settings.bounces = 4;
    const BiasMeasure measured =
        measureRegularisation(gpu::testDevice(), gallery, gallery.cameras[0], settings);
    EXPECT_NE(measured.change.value, 0.0);
    EXPECT_GT(measured.change.standard_error, 0.0);
    EXPECT_LT(measured.change.standard_error, 1.0);
}

TEST(Plan, RulesFollowFromWhatIsAsked) {
    RunSettings run;
    run.render.first_sample = 10;
    EXPECT_EQ(stopRules(run).samples, kDefaultSamples);
    run.seconds = 2.0;
    run.error = 0.5;
    EXPECT_EQ(stopRules(run).samples, kMostSamples - 10) << "indices must not run out";
    EXPECT_EQ(stopRules(run).seconds, 2.0);
    EXPECT_EQ(stopRules(run).error, 0.5);
    run.samples = 3;
    EXPECT_EQ(stopRules(run).samples, 3U);
}

TEST(Plan, ChoosesWhatIsLeftOpen) {
    const Scene furnace = *makeBuiltinScene("furnace");
    RunSettings run;
    run.render = small();
    run.render.sampler = Sequence::blue;
    run.samples = 32;
    run.auto_bounces = true;
    run.queues = QueueUse::on;
    const RunPlan plan = planRun(gpu::testDevice(), furnace, furnace.cameras[0], run);
    ASSERT_TRUE(plan.depth);
    EXPECT_EQ(plan.settings.bounces, 6U) << "a hundredth of the light is left, by default";
    EXPECT_EQ(plan.settings.blue_bits, 5U);
    EXPECT_TRUE(plan.settings.queues);
    EXPECT_FALSE(plan.regularisation);
    run.auto_bounces = false;
    run.error = 0.3;
    run.queues = QueueUse::off;
    run.render.regularise = true;
    const RunPlan other = planRun(gpu::testDevice(), furnace, furnace.cameras[0], run);
    EXPECT_FALSE(other.depth);
    EXPECT_EQ(other.settings.bounces, run.render.bounces);
    EXPECT_FALSE(other.settings.queues);
    ASSERT_TRUE(other.regularisation);
    EXPECT_EQ(other.regularisation->change.value, 0.0) << "nothing is glossy";
}

}  // namespace
}  // namespace licht
