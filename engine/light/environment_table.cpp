#include "licht/light/environment_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include "licht/colour/transfer.h"
#include "licht/light/alias_table.h"
#include "licht/shared/light.h"

namespace licht {
namespace {

// Of a texel of that row of `height`.
double solidAngle(int row, int width, int height) {
    const double half = 0.5 * std::numbers::pi / height;
    return 4.0 * std::numbers::pi / width * std::sin(half * (2 * row + 1)) * std::sin(half);
}

// The distribution function at each entry's end, rounded to units of 2^-31, so that it is exact on the
// device. Every entry that is not zero keeps at least one unit.
void writeEnds(std::span<const double> shares, std::span<uint> ends, std::size_t stride) {
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    const auto some = static_cast<uint>(
        std::count_if(shares.begin(), shares.end(), [](double share) { return share > 0.0; }));
    const auto spare = static_cast<double>(kEnvironmentUnits - some);
    double before = 0.0;
    uint some_before = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        before += shares[i];
        if (shares[i] > 0.0) ++some_before;
        if (some > 0)
            ends[i * stride] = some_before == some
                                   ? kEnvironmentUnits
                                   : some_before + static_cast<uint>(std::min(before / sum, 1.0) * spare);
    }
}

std::vector<uint> aliasWords(std::span<const double> shares) {
    std::vector<AliasRecord> table = buildAliasTable(shares);
    // Black maps have no table; the effect is off for them, unless everything is compiled in.
    if (table.empty()) table.resize(shares.size());
    std::vector<uint> words;
    words.reserve(4 * table.size());
    for (const AliasRecord& a : table)
        words.insert(words.end(),
                     {std::bit_cast<uint>(a.threshold), a.alias, std::bit_cast<uint>(a.pmf), a.reserved});
    return words;
}

}  // namespace

std::vector<double> environmentShares(const Environment& environment) {
    const Image& map = environment.radiance;
    const auto texel = [&map](int x, int y) {
        const int wrapped = (x + map.width) % map.width;
        const int clamped = std::clamp(y, 0, map.height - 1);
        return static_cast<double>(luminance(
            vec3(map.at(wrapped, clamped, 0), map.at(wrapped, clamped, 1), map.at(wrapped, clamped, 2))));
    };
    std::vector<double> shares;
    shares.reserve(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    double total = 0.0;
    for (int y = 0; y < map.height; ++y) {
        const double angle = solidAngle(y, map.width, map.height);
        double row = 0.0;
        for (int x = 0; x < map.width; ++x) {
            // The integral of the bilinear interpolant over its texel: 1/8, 6/8, 1/8 along each axis.
            double sum = 0.0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    sum += texel(x + i, y + j) * (i == 0 ? 6.0 : 1.0) * (j == 0 ? 6.0 : 1.0) / 64.0;
            shares.push_back(sum * angle);
            row += shares.back();
        }
        total += row;
    }
    if (total > 0.0)
        for (double& share : shares) share /= total;
    return shares;
}

std::vector<double> sharesAboveMean(const Environment& environment) {
    // What rounding leaves of a constant sky is far below.
    constexpr double kNothing = 1e-9;
    const int width = environment.radiance.width;
    const int height = environment.radiance.height;
    std::vector<double> shares = environmentShares(environment);
    double total = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const int row = static_cast<int>(i / static_cast<std::size_t>(width));
        shares[i] = std::max(shares[i] - solidAngle(row, width, height) / (4.0 * std::numbers::pi), 0.0);
        total += shares[i];
    }
    for (double& share : shares) share = total > kNothing ? share / total : 0.0;
    return shares;
}

EnvironmentTable buildEnvironmentTable(const std::vector<double>& shares, int width,
                                       EnvironmentSampling how) {
    const auto columns = static_cast<std::size_t>(width);
    const std::size_t rows = shares.size() / columns;
    const int height = static_cast<int>(rows);
    EnvironmentTable table;
    double peak = 0.0;
    for (std::size_t i = 0; i < shares.size(); ++i)
        peak = std::max(peak, shares[i] / solidAngle(static_cast<int>(i / columns), width, height));
    table.peak = static_cast<float>(peak);
    if (how != EnvironmentSampling::inversion) {
        table.size = uvec2(width, height);
        table.words = 4;
        table.texels = aliasWords(shares);
        return table;
    }
    table.size = uvec2(width + 1, height);
    table.texels.assign((columns + 1) * rows, 0);
    std::vector<double> row_shares;
    for (std::size_t y = 0; y < rows; ++y) {
        const std::span<const double> row = std::span(shares).subspan(y * columns, columns);
        row_shares.push_back(std::accumulate(row.begin(), row.end(), 0.0));
        writeEnds(row, std::span(table.texels).subspan(y * (columns + 1)), 1);
    }
    writeEnds(row_shares, std::span(table.texels).subspan(columns), columns + 1);
    return table;
}

}  // namespace licht
