// What an alias table really does is what it says, and what was asked for.
#include "licht/light/alias_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "licht/shared/light.h"

namespace licht {
namespace {

constexpr double kUnit = 0x1p-24;  // relative error of one fp32 rounding

void expectSound(const std::vector<double>& weights) {
    const std::vector<AliasRecord> table = buildAliasTable(weights);
    ASSERT_EQ(table.size(), weights.size());
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto count = static_cast<double>(weights.size());
    std::vector<double> picked(weights.size());
    std::vector<double> columns(weights.size());
    double total = 0.0;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const auto threshold = static_cast<double>(table[i].threshold);
        ASSERT_TRUE(threshold >= 0.0 && threshold <= 1.0) << i;
        ASSERT_LT(table[i].alias, table.size()) << i;
        picked[i] += threshold / count;
        picked[table[i].alias] += (1.0 - threshold) / count;
        columns[i] += 1.0;
        columns[table[i].alias] += 1.0;
        total += static_cast<double>(table[i].pmf);
    }
    EXPECT_NEAR(total, 1.0, kUnit + 1e-12) << "each entry rounds once, by u of itself";
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double wanted = weights[i] / sum;
        EXPECT_NEAR(static_cast<double>(table[i].pmf), wanted, kUnit * wanted) << i;
        // Every column rounds its threshold by at most u / 2, and double precision loses far less.
        ASSERT_NEAR(picked[i], wanted, columns[i] * kUnit / count) << i;
        if (weights[i] == 0.0) {
            EXPECT_EQ(picked[i], 0.0) << i;
        }
    }
}

TEST(AliasTable, picksByWeight) {
    expectSound({1.0});
    expectSound({3.0, 1.0});
    expectSound({1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0});
    expectSound({0.0, 0.0, 5.0, 0.0});
    expectSound({1e-20, 1.0, 1e15});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (const std::size_t count : {2U, 10U, 1000U, 100'000U}) {
        std::vector<double> even;
        std::vector<double> with_zeros;
        std::vector<double> heavy;
        for (std::size_t i = 0; i < count; ++i) {
            even.push_back(uniform(random));
            with_zeros.push_back(i % 3 == 0 ? uniform(random) : 0.0);
            heavy.push_back(std::exp(20.0 * uniform(random)));
        }
        expectSound(even);
        expectSound(with_zeros);
        expectSound(heavy);
    }
}

TEST(AliasTable, nothingToPickIsEmpty) {
    EXPECT_TRUE(buildAliasTable({}).empty());
    EXPECT_TRUE(buildAliasTable(std::vector<double>{0.0, 0.0}).empty());
}

}  // namespace
}  // namespace licht
