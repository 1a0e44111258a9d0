#include "licht/run/queue_choice.h"

#include <gtest/gtest.h>

#include "licht/core/error.h"
#include "licht/settings/settings.h"
#include "samples/licht/options.h"

namespace licht {
namespace {

RenderSettings picture() {
    RenderSettings settings;
    settings.size = {1000, 1000};
    settings.bounces = 8;
    return settings;
}

StopRules samples(std::uint32_t count) {
    StopRules rules;
    rules.samples = count;
    return rules;
}

constexpr QueueDevice kRefills{true, {}};

bool automatic(const RenderSettings& settings, const StopRules& rules) {
    return chooseQueues(QueueUse::automatic, settings, rules, kRefills).queues;
}

TEST(QueueChoice, LongRunsTakeQueuesAndShortOnesDoNot) {
    EXPECT_TRUE(automatic(picture(), samples(64)));
    EXPECT_FALSE(automatic(picture(), samples(1)));
    RenderSettings flat = picture();
    flat.bounces = 0;  // nothing is traced
    EXPECT_FALSE(automatic(flat, samples(1'000'000)));
    // Roulette and absorption end most paths: deep ones are not taken for longer.
    RenderSettings deep = picture();
    deep.bounces = 40;
    EXPECT_FALSE(automatic(deep, samples(1)));
}

TEST(QueueChoice, TimeAndErrorSayHowLong) {
    StopRules rules;
    rules.error = 0.01;
    EXPECT_TRUE(automatic(picture(), rules));
    rules.error.reset();
    rules.seconds = 60.0;
    EXPECT_TRUE(automatic(picture(), rules));
    rules.seconds = 1.0;
    EXPECT_FALSE(automatic(picture(), rules));
}

TEST(QueueChoice, WhatQueuesCannotDoOrDoNotSpeedUpIsNotChosen) {
    RenderSettings deep = picture();
    deep.bounces = 41;
    EXPECT_FALSE(automatic(deep, samples(64)));
    EXPECT_FALSE(chooseQueues(QueueUse::automatic, picture(), samples(64), {}).queues);
}

TEST(QueueChoice, AnOperationThatTheDeviceGetsWrongLeavesOneKernelAndIsNamed) {
    const QueueDevice wrong{true, "subgroupElect"};
    for (const QueueUse use : {QueueUse::on, QueueUse::automatic}) {
        const QueueChoice choice = chooseQueues(use, picture(), samples(64), wrong);
        EXPECT_FALSE(choice.queues);
        EXPECT_EQ(choice.trouble, "subgroupElect");
    }
    EXPECT_EQ(chooseQueues(QueueUse::off, picture(), samples(64), wrong).trouble, "") << "not missed";
    EXPECT_EQ(chooseQueues(QueueUse::automatic, picture(), samples(1), wrong).trouble, "") << "not missed";
}

TEST(QueueChoice, WhatIsAskedForIsDone) {
    EXPECT_TRUE(chooseQueues(QueueUse::on, picture(), samples(1), {}).queues);
    EXPECT_FALSE(chooseQueues(QueueUse::off, picture(), samples(64), kRefills).queues);
    EXPECT_EQ(parseChoice<QueueUse>("--queues", "auto"), QueueUse::automatic);
    EXPECT_THROW(parseChoice<QueueUse>("--queues", "yes"), InputError);
}

}  // namespace
}  // namespace licht
