#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "licht/core/math.h"
#include "licht/image/image.h"
#include "licht/settings/layers.h"

namespace licht {

/// What was accumulated so far, on the host. Planes are width * height, from the top left.
struct Film {
    uvec2 size{0};
    std::uint32_t samples = 0;
    Image mean;      ///< RGBA: linear radiance, cd/m^2; alpha: share of samples that saw surface, sky or sun
    Image variance;  ///< RGB: estimated variance of the mean above (zero while samples < 2)
    /// Where the picture is filtered, `mean` is what the filter made and `variance` its estimated squared
    /// error, bias included (empty where nothing is known of it); this is the mean of the samples, RGBA,
    /// which is otherwise empty.
    Image unfiltered;
    double filter_bias = -1.0;       ///< relative, root of the mean square, estimated; negative: not filtered
    double unfiltered_error = -1.0;  ///< relative, estimated as of independent samples; negative: not
                                     ///< filtered, or unknown
    Image counts;                    ///< samples per pixel, where they differ; `samples` is then their mean
    std::vector<Image> orders;       ///< RGB of T^i Le each, when asked for; they sum to the mean
    Image lost;                      ///< RGB: what the clamp took, where it is on

    /// What passes drew, where it was asked for, else empty.
    [[nodiscard]] const Image& layer(LayerId id) const { return layers[static_cast<std::size_t>(id)]; }
    [[nodiscard]] Image& layer(LayerId id) { return layers[static_cast<std::size_t>(id)]; }
    std::array<Image, kLayerCount> layers;
};

/// Means over the picture, RGB in cd/m^2, of samples that followed one another: batches tell how sure the
/// mean of all of them is.
struct LightBatch {
    std::uint32_t samples = 0;       ///< of every pixel
    std::vector<glm::dvec3> orders;  ///< T^i Le
    glm::dvec3 lost{0.0};            ///< what the clamp took
};

/// Merges two films of disjoint sample ranges (Chan, Golub, LeVeque 1979, Updating Formulae and a Pairwise
/// Algorithm for Computing Sample Variances).
Film mergeFilms(const Film& a, const Film& b);

}  // namespace licht
