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

bool automatic(const RenderSettings& settings, const StopRules& rules) {
    return chooseQueues(QueueUse::automatic, settings, rules, true);
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
    EXPECT_FALSE(chooseQueues(QueueUse::automatic, picture(), samples(64), false));
}

TEST(QueueChoice, WhatIsAskedForIsDone) {
    EXPECT_TRUE(chooseQueues(QueueUse::on, picture(), samples(1), false));
    EXPECT_FALSE(chooseQueues(QueueUse::off, picture(), samples(64), true));
    EXPECT_EQ(parseChoice<QueueUse>("--queues", "auto"), QueueUse::automatic);
    EXPECT_THROW(parseChoice<QueueUse>("--queues", "yes"), InputError);
}

}  // namespace
}  // namespace licht
