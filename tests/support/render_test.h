#pragma once
// What image tests share: rendering on the test device, means with their standard errors, and pictures that a
// failure leaves behind.
#include <string>

#include "licht/film/film.h"
#include "licht/image/image.h"
#include "licht/scene/scene.h"
#include "licht/settings/settings.h"

namespace licht {

/// Renders that many samples on the test device. Fails the test when a sample was no number or a traversal
/// was cut.
Film renderFilm(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                std::uint32_t samples);

/// Mean of one channel over the whole picture and the standard error of that mean, from the variances of the
/// pixels.
struct PictureMean {
    double mean = 0.0;
    double standard_error = 0.0;
};
PictureMean pictureMean(const Film& film, int channel);

/// |mean - exact| <= 4.5 standard errors + 1e-5 exact: a false alarm in 7e-6 of the runs, and the rounding of
/// fp32 sums.
void expectMean(const Film& film, double exact);

/// Least count that a Poisson variable of this mean exceeds with at most the chance `beyond`.
double poissonQuantile(double mean, double beyond);

/// Looks straight down on the square [-half, half]^2 around `centre` (XZ), from `height` metres above it.
/// Exactly the square fills a square picture.
Camera downCamera(const vec3& centre, float half, float height);

/// A Lambertian material, no specular layer.
Material lambert(float albedo, float emission = 0.0F);

/// A floor under a lamp, both whole in view of each other: a smooth integrand but for the lamp's rim, which
/// scattering sees.
Scene litFloor();
/// Sees the middle of that floor from below the lamp.
Camera litFloorCamera();

/// RGB of a film's RGBA mean.
Image colorOf(const Film& film);

/// Demands that both films are of one picture (zTest). On failure writes <name>_{image,reference}.exr with
/// the variances and <name>_p_values.exr to the folder test_output and names them.
void expectSamePicture(const Film& film, const Film& reference, const std::string& name);

}  // namespace licht
