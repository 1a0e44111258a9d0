#pragma once
// Counting samples in cells and comparing the counts with what a density promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "licht/measure/chi2.h"
#include "licht/measure/ztest.h"

namespace licht::test {

/// Counts per cell of a grid over [0,1)^2. What lies outside counts as the nearest cell.
class Histogram {
public:
    Histogram(std::size_t columns, std::size_t rows)
        : columns_(columns), rows_(rows), counts_(columns * rows) {}

    void add(double x, double y) { ++counts_[cell(y, rows_) * columns_ + cell(x, columns_)]; }
    [[nodiscard]] const std::vector<std::uint64_t>& counts() const { return counts_; }
    [[nodiscard]] std::vector<double> uniform() const {
        double total = 0.0;
        for (const std::uint64_t count : counts_) total += static_cast<double>(count);
        return std::vector<double>(counts_.size(), total / static_cast<double>(counts_.size()));
    }

private:
    static std::size_t cell(double x, std::size_t cells) {
        return static_cast<std::size_t>(
            std::clamp(x * static_cast<double>(cells), 0.0, static_cast<double>(cells) - 1.0));
    }
    std::size_t columns_;
    std::size_t rows_;
    std::vector<std::uint64_t> counts_;
};

/// Fails where counts are this unlikely: 0.001 for all `tests` of a file together (Sidak's correction).
inline void expectLikely(const std::string& name, const std::vector<std::uint64_t>& counts,
                         const std::vector<double>& expected, int tests) {
    const ChiSquareResult result = chiSquareTest(counts, expected);
    EXPECT_GT(result.degrees, 0U) << name;
    EXPECT_GT(result.p, sidakThreshold(0.001, tests))
        << name << ": chi-square " << result.statistic << " with " << result.degrees << " degrees of freedom";
}

}  // namespace licht::test
