#pragma once
#include <vector>

#include "licht/scene/scene.h"
#include "licht/settings/settings.h"

namespace licht {

/// The probability of each texel of an environment, from the top left: the integral of the bilinear luminance
/// over the texel, by solid angle. Sums to one; a map without light: all zero.
std::vector<double> environmentShares(const Environment& environment);

/// What the shares have above those of a sky of the same mean, again summing to one: enough to draw by where
/// scattering is sampled as well and finds the rest. All zero where nothing stands out, as in a constant sky.
/// Karlik, Sik, Vevoda, Skrivan and Krivanek 2019, MIS Compensation: Optimizing Sampling Techniques in
/// Multiple Importance Sampling.
std::vector<double> sharesAboveMean(const Environment& environment);

/// What drawing directions by these shares takes, as an image of unsigned words;
/// shaders/light/sky.glsl reads it.
struct EnvironmentTable {
    uvec2 size{1, 1};  ///< texels
    uint words = 1;    ///< of a texel: 1 or 4
    std::vector<uint> texels{0};
    float peak = 0.0F;  ///< largest density of a direction, 1/sr
};

/// alias and rejection: an alias table over the texels, an AliasRecord a texel. inversion: the distribution
/// function of the texels of each row, and in one more column that of the rows, in units of 2^-31. What the
/// shaders take for the probability of a texel is what the table does; no texel with a share has none.
/// `shares` of a map of so many columns.
EnvironmentTable buildEnvironmentTable(const std::vector<double>& shares, int width, EnvironmentSampling how);

}  // namespace licht
