#pragma once
#include <cstdint>

namespace licht {

/// Mean and variance of a stream of numbers, updated one by one without cancellation
/// (Welford 1962, "Note on a method for calculating corrected sums of squares and products").
class RunningStatistics {
public:
    void add(double value) {
        ++count_;
        const double before = value - mean_;
        mean_ += before / static_cast<double>(count_);
        squares_ += before * (value - mean_);
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] double mean() const { return mean_; }
    /// Unbiased variance of one value; 0 with fewer than two values.
    [[nodiscard]] double variance() const {
        return count_ < 2 ? 0.0 : squares_ / static_cast<double>(count_ - 1);
    }
    /// Unbiased variance of mean().
    [[nodiscard]] double varianceOfMean() const {
        return count_ < 2 ? 0.0 : variance() / static_cast<double>(count_);
    }

private:
    std::uint64_t count_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;  ///< sum of squared distances to the mean
};

}  // namespace licht
