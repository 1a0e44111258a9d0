// Vertices that are no place, and scenes of random bits: the picture is that of the rest.
#include <gtest/gtest.h>

#include <bit>
#include <iostream>
#include <limits>
#include <random>

#include "hard.h"
#include "licht/core/error.h"
#include "licht/film/film.h"
#include "licht/scene/gltf.h"
#include "pictures.h"
#include "support/gltf_file.h"

namespace licht {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A quad that glows 2 and, with `bad`, triangles that each have one bad coordinate, as a file.
test::GltfFile fileWith(const std::vector<float>& bad, const test::Json& node) {
    test::GltfFile file;
    std::vector<float> positions{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    std::vector<std::uint16_t> indices{0, 1, 2, 0, 2, 3};
    std::uint16_t vertex = 4;
    for (const float value : bad) {
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<float> v{0, 0, 1};
            v[static_cast<std::size_t>(axis)] = value;
            positions.insert(positions.end(), v.begin(), v.end());
            indices.insert(indices.end(), {0, 1, vertex++});
        }
    }
    file.add("materials", {{"emissiveFactor", {1, 1, 1}}, {"doubleSided", true}});
    const int p = file.vec3s(positions);
    file.mesh({{"attributes", {{"POSITION", p}}}, {"indices", file.indices(indices)}, {"material", 0}});
    test::Json root = node;
    root["mesh"] = 0;
    file.root(root);
    return file;
}

Film render(const Scene& scene) {
    return renderFilm(scene, lookingCamera("viewer", vec3(0, 0.2F, 4), vec3(0.0F), 0.8F),
                      test::picture(48, 2), 2);
}

TEST(BadVertices, InAFileThePictureIsThatOfTheRestWithOneWarning) {
    const test::TemporaryFolder folder;
    const Scene clean = loadGltf(fileWith({}, {}).writeGlb(folder));
    const Film expected = render(clean);
    EXPECT_GT(test::largestOf(expected.mean, 0), 0.5F);
    const Scene scene = loadGltf(fileWith({kNan, kInfinity, -kInfinity, 1e30F}, {}).writeGlb(folder));
    int warnings = 0;
    for (const SceneNote& note : scene.notes) {
        warnings += note.text.find("12 triangles") != std::string::npos ? 1 : 0;
    }
    EXPECT_EQ(warnings, 1);
    EXPECT_EQ(scene.notes.size(), clean.notes.size() + 1);
    EXPECT_TRUE(test::identical(render(scene).mean, expected.mean));
}

// Scene is plain values that programs fill in: its bad triangles are the renderer's to leave out.
TEST(BadVertices, InASceneThePictureIsThatOfTheRest) {
    Scene scene;
    scene.materials = {lambert(0.5F, 2.0F)};
    scene.materials[0].double_sided = true;
    place(scene, boxMesh("box", 0, vec3(-1), vec3(1)));
    const Film expected = render(scene);
    for (const float value : {kNan, kInfinity, -kInfinity, 1e30F}) {
        Scene spoilt = scene;
        for (int axis = 0; axis < 3; ++axis) {
            Mesh bad;
            bad.name = "bad";
            bad.positions = {vec3(-3, -1, 1), vec3(3, -1, 1), vec3(0, 1, 1)};
            bad.positions[2][axis] = value;
            bad.triangles = {uvec3(0, 1, 2)};
            place(spoilt, bad);
        }
        EXPECT_TRUE(test::identical(render(spoilt).mean, expected.mean)) << value;
    }
}

// Places that are none only once the node has scaled them.
TEST(BadVertices, ScaledOutOfRangeTheyAreNotSeenEither) {
    Scene scene;
    scene.materials = {lambert(0.5F, 2.0F)};
    scene.materials[0].double_sided = true;
    place(scene, boxMesh("box", 0, vec3(-1), vec3(1)));
    const Film expected = render(scene);
    place(scene,
          quadMesh("far", 0, vec3(-1e9F, -1e9F, 0), vec3(1e9F, -1e9F, 0), vec3(1e9F, 1e9F, 0),
                   vec3(-1e9F, 1e9F, 0)),
          glm::scale(mat4(1.0F), vec3(1e10F)));
    EXPECT_TRUE(test::identical(render(scene).mean, expected.mean));
}

/// Random bits for every coordinate; an index is random with probability 1/32 (after Embree's own test).
Scene garbage(std::mt19937& engine) {
    Scene scene;
    scene.materials = {lambert(0.5F, 1.0F)};
    for (int m = 0; m < 20; ++m) {
        Mesh mesh;
        mesh.name = "garbage";
        const std::uint32_t primitives = engine() % 256 + 1;
        for (std::uint32_t i = 0; i < 3 * primitives; ++i) {
            mesh.positions.emplace_back(std::bit_cast<float>(static_cast<std::uint32_t>(engine())),
                                        std::bit_cast<float>(static_cast<std::uint32_t>(engine())),
                                        std::bit_cast<float>(static_cast<std::uint32_t>(engine())));
        }
        for (std::uint32_t i = 0; i < primitives; ++i) {
            const auto index = [&](std::uint32_t k) {
                return engine() % 32 == 0 ? static_cast<std::uint32_t>(engine()) : 3 * i + k;
            };
            mesh.triangles.emplace_back(index(0), index(1), index(2));
        }
        place(scene, std::move(mesh));
    }
    return scene;
}

/// Wild indices are refused by name; without them the scene goes on.
void refuseAndMend(Scene& scene) {
    try {
        validateScene(scene);
        ADD_FAILURE() << "indices of 2^32 were accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("vertex that is not there"), std::string::npos)
            << error.what();
    }
    for (Mesh& mesh : scene.meshes) {
        std::erase_if(mesh.triangles, [&](const uvec3& t) {
            const auto n = static_cast<std::uint32_t>(mesh.positions.size());
            return t.x >= n || t.y >= n || t.z >= n;
        });
    }
    validateScene(scene);
}

TEST(Garbage, TreesOfRandomBitsAnswerAsTestingEveryTriangle) {
    std::mt19937 engine(1);
    test::Random random(2);
    const std::size_t scenes = test::often(100, 1'000);
    std::size_t kept = 0;
    std::size_t hits = 0;
    std::size_t different = 0;
    for (std::size_t s = 0; s < scenes; ++s) {
        Scene scene = garbage(engine);
        refuseAndMend(scene);
        std::vector<BvhTriangle> triangles;
        for (const Mesh& mesh : scene.meshes) {
            for (const uvec3& t : mesh.triangles) {
                triangles.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
            }
        }
        const Bvh bvh = buildBvh(triangles);
        ASSERT_EQ(bvh.triangle_ids.size() + bvh.dropped, triangles.size());
        kept += bvh.triangle_ids.size();
        for (int i = 0; i < 30; ++i) {
            Ray ray{random.inCube(1.0F), random.direction()};
            if (!bvh.triangle_ids.empty() && i % 2 == 0) {  // towards something
                const BvhTriangle& t = triangles[bvh.triangle_ids[random.index(bvh.triangle_ids.size())]];
                ray.direction = t.v0 / 3.0F + t.v1 / 3.0F + t.v2 / 3.0F - ray.origin;
            } else if (i % 8 == 1) {  // a garbage ray
                ray = {vec3(std::bit_cast<float>(static_cast<std::uint32_t>(engine()))), ray.direction};
            }
            const auto hit = intersect(bvh, triangles, ray);
            hits += hit ? 1U : 0U;
            different += test::same(hit, intersectBruteForce(triangles, ray)) ? 0U : 1U;
        }
    }
    std::cout << kept << " triangles kept in " << scenes << " scenes, " << hits << " hits\n";
    EXPECT_GT(hits, scenes);
    EXPECT_EQ(different, 0U);
}

TEST(Garbage, RendersAndNoSampleIsNoNumber) {
    std::mt19937 engine(3);
    for (std::size_t s = 0; s < test::often(3, 100); ++s) {
        Scene scene = garbage(engine);
        refuseAndMend(scene);
        for (Mesh& mesh : scene.meshes) {  // as the loader does
            std::erase_if(mesh.triangles, [&](const uvec3& t) {
                return !isPlace(mesh.positions[t.x]) || !isPlace(mesh.positions[t.y]) ||
                       !isPlace(mesh.positions[t.z]);
            });
        }
        scene.environment = constantEnvironment(vec3(1.0F));
        // renderFilm() demands that no sample was NaN or infinite and no walk was cut.
        const Film film = render(scene);
        for (const float value : film.mean.texels) {
            ASSERT_TRUE(std::isfinite(value)) << "scene " << s;
        }
    }
}

}  // namespace
}  // namespace licht
