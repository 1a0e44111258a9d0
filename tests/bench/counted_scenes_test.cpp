// Scenes that are asked for a count of triangles have it, and are the same each time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <tuple>

#include "samples/scenes/builtin.h"

namespace licht {
namespace {

std::uint64_t trianglesIn(const Scene& scene) {
    std::uint64_t sum = 0;
    for (const Instance& instance : scene.instances) sum += scene.meshes[instance.mesh].triangles.size();
    return sum;
}

class CountedScene : public testing::TestWithParam<std::tuple<std::string, std::uint64_t>> {};

TEST_P(CountedScene, HasWhatWasAskedForToOnePercent) {
    const auto& [name, wanted] = GetParam();
    const auto made = static_cast<double>(trianglesIn(makeBuiltinScene(name, wanted).value()));
    EXPECT_NEAR(made, static_cast<double>(wanted), 0.01 * static_cast<double>(wanted));
}

INSTANTIATE_TEST_SUITE_P(
    Counts, CountedScene,
    testing::Combine(testing::Values("terrain", "spheres"),
                     testing::Values(kFewestTriangles, 1'234U, 30'000U, 99'991U, 300'000U)),
    [](const auto& run) { return std::get<0>(run.param) + std::to_string(std::get<1>(run.param)); });

TEST(CountedScenes, NoTriangleIsWithoutArea) {
    for (const char* name : {"terrain", "spheres"}) {
        const Scene scene = makeBuiltinScene(name, 30'000).value();
        for (const Mesh& mesh : scene.meshes) {
            for (const uvec3& t : mesh.triangles) {
                const vec3 a = mesh.positions[t.x];
                EXPECT_GT(glm::length(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a)), 0.0F)
                    << name;
            }
        }
    }
}

TEST(CountedScenes, TerrainFacesUpAndItsNormalsAgreeWithItsFaces) {
    const Scene scene = makeBuiltinScene("terrain", 20'000).value();
    const Mesh& ground = scene.meshes[0];
    for (const uvec3& t : ground.triangles) {
        const vec3 a = ground.positions[t.x];
        const vec3 area = glm::cross(ground.positions[t.y] - a, ground.positions[t.z] - a);
        EXPECT_GT(area.y, 0.0F);
        for (int k = 0; k < 3; ++k) EXPECT_GT(ground.normals[t[k]].y, 0.0F);
    }
}

}  // namespace
}  // namespace licht
