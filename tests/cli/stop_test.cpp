#include "licht/run/stop.h"

#include <gtest/gtest.h>

#include <cmath>

namespace licht {
namespace {

Advance at(std::uint32_t samples, double seconds, double error = -1.0, std::uint32_t error_samples = 0) {
    return {samples, seconds, error, error_samples, false};
}

TEST(DecideStop, FirstLimitReachedWins) {
    const StopRules rules{100, 10.0, 0.1};
    EXPECT_EQ(decideStop(rules, at(99, 9.9, 0.11, 64)), Stop::none);
    EXPECT_EQ(decideStop(rules, at(100, 9.9, 0.11, 64)), Stop::samples);
    EXPECT_EQ(decideStop(rules, at(99, 10.0, 0.11, 64)), Stop::time);
    EXPECT_EQ(decideStop(rules, at(99, 9.9, 0.1, 64)), Stop::error);
}

TEST(DecideStop, AlwaysOneSample) {
    Advance nothing = at(0, 100.0);
    nothing.interrupted = true;
    EXPECT_EQ(decideStop({1, 1.0, 1.0}, nothing), Stop::none);
}

TEST(DecideStop, InterruptEndsWhatNothingElseEnded) {
    Advance advance = at(5, 1.0);
    advance.interrupted = true;
    EXPECT_EQ(decideStop({100, {}, {}}, advance), Stop::interrupt);
    EXPECT_EQ(decideStop({5, {}, {}}, advance), Stop::samples);
}

TEST(DecideStop, DistrustsEarlyOrUnknownErrors) {
    const StopRules rules{1000, {}, 0.5};
    EXPECT_EQ(decideStop(rules, at(900, 1.0)), Stop::none);
    EXPECT_EQ(decideStop(rules, at(kFewestSamplesToTrust, 1.0, 0.0, kFewestSamplesToTrust - 1)), Stop::none);
    EXPECT_EQ(decideStop(rules, at(kFewestSamplesToTrust, 1.0, 0.0, kFewestSamplesToTrust)), Stop::error);
}

TEST(Forecast, ErrorFallsWithTheSquareRoot) {
    // A tenth of the error of 16 samples takes 1600.
    EXPECT_DOUBLE_EQ(samplesToReach(0.02, at(20, 1.0, 0.2, 16)).value(), 1600.0);
    EXPECT_FALSE(samplesToReach(0.02, at(20, 1.0)).has_value());
}

TEST(Forecast, SecondsLeftIsTheNearestLimit) {
    EXPECT_DOUBLE_EQ(secondsLeft({100, {}, {}}, at(25, 5.0)), 15.0);
    EXPECT_DOUBLE_EQ(secondsLeft({100, 8.0, {}}, at(25, 5.0)), 3.0);
    // 0.2 at 16 samples, 0.1 wanted: 64 samples, 32 more of 0.125 s each
    EXPECT_DOUBLE_EQ(secondsLeft({1000, {}, 0.1}, at(32, 4.0, 0.2, 16)), 4.0);
    EXPECT_LT(secondsLeft({}, at(32, 4.0)), 0.0);
    EXPECT_DOUBLE_EQ(secondsLeft({100, 4.0, {}}, at(25, 5.0)), 0.0);
}

TEST(ErrorSchedule, CountsDouble) {
    ErrorSchedule schedule({});
    EXPECT_FALSE(schedule.due(3, 0.03));
    EXPECT_TRUE(schedule.due(4, 0.04));
    schedule.checked(at(4, 0.04, 0.5, 4), 0.0);
    EXPECT_FALSE(schedule.due(7, 0.07));
    EXPECT_TRUE(schedule.due(8, 0.08));
}

TEST(ErrorSchedule, LooksWhereTheErrorIsForecast) {
    ErrorSchedule schedule(0.1);
    schedule.checked(at(100, 1.0, 0.11, 100), 0.0);
    EXPECT_FALSE(schedule.due(120, 1.2));  // 100 * 1.21 = 121 samples
    EXPECT_TRUE(schedule.due(121, 1.21) || schedule.due(122, 1.22));
}

// From 64 to 128 in blocks of 16.
TEST(ErrorSchedule, RoundsForecastsUpToWholeBlocks) {
    ErrorSchedule schedule(0.1, true);
    schedule.checked(at(100, 1.0, 0.105, 100), 0.0);  // 110.25
    EXPECT_FALSE(schedule.due(111, 1.11));
    EXPECT_TRUE(schedule.due(112, 1.12));
    schedule.checked(at(112, 1.12, 0.101, 112), 0.0);
    EXPECT_FALSE(schedule.due(127, 1.27));
    EXPECT_TRUE(schedule.due(128, 1.28));
}

TEST(ErrorSchedule, TakesAtMostATwentiethOfTheTime) {
    ErrorSchedule schedule(0.001);
    const double cost = 0.3;
    double spent = 0.0;
    double seconds = 0.0;
    std::uint32_t samples = 0;
    for (; seconds < 200.0; seconds += 0.1) {
        ++samples;
        if (!schedule.due(samples, seconds)) continue;
        seconds += cost;
        spent += cost;
        schedule.checked(at(samples, seconds, 1.0 / std::sqrt(samples), samples), cost);
    }
    EXPECT_GT(spent, 5.0 * cost);
    // The first look is free of the rule, because its cost is not known before.
    EXPECT_LE(spent - cost, 0.05 * seconds);
}

TEST(ErrorSchedule, LooksEveryTwoSecondsWhereSamplesAreSlow) {
    ErrorSchedule schedule({});
    schedule.checked(at(16, 10.0, 0.2, 16), 0.001);
    EXPECT_FALSE(schedule.due(18, 11.9));
    EXPECT_TRUE(schedule.due(18, 12.0));
}

}  // namespace
}  // namespace licht
