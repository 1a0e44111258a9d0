#pragma once
// How far pictures are from a reference.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "licht/image/image.h"
#include "licht/measure/ztest.h"

namespace licht {

/// What an EXR file has of a picture: colours, how sure they are, and what its attributes say of its making.
struct MeasuredPicture {
    std::string name;               ///< as it was asked for
    Image mean;                     ///< R, G, B
    std::optional<Image> variance;  ///< of the mean, where the file has that layer
    std::string samples, seconds;   ///< empty: the file does not say
    bool filtered = false;          ///< by --denoise: its pixels depend on each other
};

/// Throws InputError: not readable as EXR, without R, G and B, or with a value in them that is no finite
/// number.
MeasuredPicture readMeasured(const std::filesystem::path& path);

struct Comparison {
    double rel_mse = 0.0;
    double trimmed_rel_mse = 0.0;
    double mse = 0.0;
    double largest = 0.0;            ///< difference of two values
    double flip = 0.0;               ///< of both as an sRGB display shows them
    std::vector<double> mean_ratio;  ///< picture over reference per channel; NaN where both are black
    std::optional<ZTestResult> z;    ///< where both know their variance and neither is filtered
};

/// Throws InputError when the sizes differ.
Comparison comparePictures(const MeasuredPicture& picture, const MeasuredPicture& reference);

}  // namespace licht
