#include "support/render_test.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "licht/image/exr.h"
#include "licht/measure/ztest.h"
#include "licht/render/renderer.h"
#include "samples/scenes/assembly.h"
#include "samples/scenes/shapes.h"
#include "support/gpu_test.h"

namespace licht {
namespace {

void addPlanes(ExrPicture& picture, const Image& image, const std::vector<std::string>& names) {
    for (std::size_t c = 0; c < names.size(); ++c) {
        ExrChannel channel{names[c], {}};
        for (std::size_t i = c; i < image.texels.size(); i += static_cast<std::size_t>(image.channels))
            channel.values.push_back(image.texels[i]);
        picture.channels.push_back(std::move(channel));
    }
}

void leave(const std::string& path, const Image& color, const Image* variance) {
    ExrPicture picture;
    picture.width = color.width;
    picture.height = color.height;
    addPlanes(picture, color, {"R", "G", "B"});
    if (variance != nullptr) addPlanes(picture, *variance, {"variance.R", "variance.G", "variance.B"});
    writeExr(path, picture);
}

}  // namespace

Film renderFilm(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                std::uint32_t samples) {
    Renderer renderer(gpu::testDevice(), scene, camera, settings);
    for (std::uint32_t i = 0; i < samples; ++i) renderer.renderSample();
    Film film = renderer.readFilm();
    EXPECT_EQ(renderer.statistics().nonfinite_samples, 0U);
    EXPECT_EQ(renderer.statistics().truncated_traversals, 0U);
    return film;
}

PictureMean pictureMean(const Film& film, int channel) {
    double sum = 0.0;
    double variance = 0.0;
    for (int y = 0; y < film.mean.height; ++y) {
        for (int x = 0; x < film.mean.width; ++x) {
            sum += static_cast<double>(film.mean.at(x, y, channel));
            variance += static_cast<double>(film.variance.at(x, y, channel));
        }
    }
    const double pixels = static_cast<double>(film.mean.width) * film.mean.height;
    return {sum / pixels, std::sqrt(variance) / pixels};
}

void expectMean(const Film& film, double exact) {
    for (int c = 0; c < 3; ++c) {
        const PictureMean picture = pictureMean(film, c);
        EXPECT_NEAR(picture.mean, exact, 4.5 * picture.standard_error + 1e-5 * exact)
            << "standard error " << picture.standard_error;
    }
}

double poissonQuantile(double mean, double beyond) {
    double count = 0.0;
    double term = std::exp(-mean);
    double below = term;
    while (1.0 - below > beyond) {
        count += 1.0;
        term *= mean / count;
        below += term;
    }
    return count;
}

Camera downCamera(const vec3& centre, float half, float height) {
    Camera camera;
    camera.kind = Camera::Kind::orthographic;
    camera.y_extent = half;
    camera.z_near = 0.01F * height;
    camera.world_from_view =
        mat4(vec4(1, 0, 0, 0), vec4(0, 0, -1, 0), vec4(0, 1, 0, 0), vec4(centre + vec3(0, height, 0), 1));
    return camera;
}

Material lambert(float albedo, float emission) {
    Material m;
    m.name = fmt::format("albedo {} emission {}", albedo, emission);
    m.base_color = vec4(vec3(albedo), 1.0F);
    m.emission = vec3(emission);
    m.metallic = 0.0F;
    m.specular = 0.0F;
    return m;
}

Scene litFloor() {
    Scene scene;
    scene.materials = {lambert(0.5F), lambert(0.0F, 4.0F)};
    place(scene, quadMesh("floor", 0, vec3(-4, 0, 4), vec3(4, 0, 4), vec3(4, 0, -4), vec3(-4, 0, -4)));
    place(scene, quadMesh("lamp", 1, vec3(-0.5F, 1, -0.5F), vec3(0.5F, 1, -0.5F), vec3(0.5F, 1, 0.5F),
                          vec3(-0.5F, 1, 0.5F)));
    return scene;
}

Camera litFloorCamera() {
    return downCamera(vec3(0.0F), 0.4F, 0.9F);
}

Image colorOf(const Film& film) {
    return withoutAlpha(film.mean);
}

void expectSamePicture(const Film& film, const Film& reference, const std::string& name) {
    const Image color = colorOf(film);
    const Image reference_color = colorOf(reference);
    const ZTestResult result = zTest({color, film.variance}, {reference_color, reference.variance});
    if (result.passed()) return;
    const std::filesystem::path folder = "test_output";
    std::filesystem::create_directories(folder);
    leave(folder / (name + "_image.exr"), color, &film.variance);
    leave(folder / (name + "_reference.exr"), reference_color, &reference.variance);
    leave(folder / (name + "_p_values.exr"), result.p_values, nullptr);
    ADD_FAILURE() << name << ": " << 100.0 * result.pass_share
                  << " % of the pixels pass, smallest p of a block " << result.smallest_block_p
                  << " (threshold " << result.block_threshold << "), of the picture "
                  << result.smallest_whole_p << " (threshold " << result.whole_threshold << "); pictures in "
                  << std::filesystem::absolute(folder).string();
}

}  // namespace licht
