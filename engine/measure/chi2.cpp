#include "licht/measure/chi2.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace licht {
namespace {

constexpr double kSmallestExpected = 5.0;
// The expansions stop at the rounding of a few operations, below which their factors need not settle.
constexpr double kPrecision = 4.0 * std::numeric_limits<double>::epsilon();

/// x^a e^-x / Gamma(a), the factor both expansions share.
double leadingFactor(double a, double x) {
    return std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Abramowitz and Stegun 1964, "Handbook of Mathematical Functions", 6.5.29: the series of the lower
/// function; all terms are positive and fall once n > x - a.
double lowerBySeries(double a, double x) {
    double term = 1.0 / a;
    double sum = term;
    for (double n = 1.0; term > kPrecision * sum; ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return leadingFactor(a, x) * sum;
}

/// Abramowitz and Stegun 6.5.31 in its contracted (even) form, evaluated by Lentz' method in the version of
/// Thompson and Barnett 1986, "Coulomb and Bessel functions of complex arguments and order". For x > a + 1 no
/// denominator vanishes.
double upperByFraction(double a, double x) {
    double b = x + 1.0 - a;
    double d = 1.0 / b;
    double c = std::numeric_limits<double>::infinity();
    double fraction = d;
    double change = 0.0;
    for (double n = 1.0; std::abs(change - 1.0) > kPrecision; ++n) {
        const double numerator = -n * (n - a);
        b += 2.0;
        d = 1.0 / (numerator * d + b);
        c = b + numerator / c;
        change = c * d;
        fraction *= change;
    }
    return leadingFactor(a, x) * fraction;
}

struct Cell {
    double observed = 0.0;
    double expected = 0.0;
};

/// Cells in ascending order of expectation, the smallest ones merged until every cell expects enough.
std::vector<Cell> pool(std::vector<Cell> cells) {
    std::ranges::sort(cells, {}, &Cell::expected);
    std::size_t merged = 0;
    Cell small;
    while (merged < cells.size() && (cells[merged].expected < kSmallestExpected ||
                                     (merged > 0 && small.expected < kSmallestExpected))) {
        small.observed += cells[merged].observed;
        small.expected += cells[merged].expected;
        ++merged;
    }
    if (merged == 0) return cells;
    std::vector<Cell> pooled(cells.begin() + static_cast<std::ptrdiff_t>(merged), cells.end());
    pooled.push_back(small);
    return pooled;
}

}  // namespace

double upperIncompleteGamma(double a, double x) {
    assert(a > 0.0 && x >= 0.0);
    if (x == 0.0) return 1.0;
    if (std::isinf(x)) return 0.0;
    return x < a + 1.0 ? 1.0 - lowerBySeries(a, x) : upperByFraction(a, x);
}

ChiSquareResult chiSquareTest(std::span<const std::uint64_t> observed, std::span<const double> expected) {
    assert(observed.size() == expected.size());
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        assert(expected[i] >= 0.0);
        if (expected[i] > 0.0)
            cells.push_back({static_cast<double>(observed[i]), expected[i]});
        else if (observed[i] > 0)
            return {std::numeric_limits<double>::infinity(), 0, 0.0};
    }
    const std::vector<Cell> pooled = pool(std::move(cells));
    if (pooled.size() < 2) return {};
    ChiSquareResult result;
    result.degrees = pooled.size() - 1;
    for (const Cell& cell : pooled)
        result.statistic += (cell.observed - cell.expected) * (cell.observed - cell.expected) / cell.expected;
    result.p = upperIncompleteGamma(0.5 * static_cast<double>(result.degrees), 0.5 * result.statistic);
    return result;
}

}  // namespace licht
