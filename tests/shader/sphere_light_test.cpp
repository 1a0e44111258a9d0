// Round meshes as lights on the device: directions spread evenly over the cone, rays that arrive where their
// light is what they meet first, and one density for what is sampled and what is looked up.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "histogram.h"
#include "kernel.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/scene/effects.h"
#include "licht/settings/settings.h"
#include "licht/shared/choices.h"
#include "licht/shared/constants.h"
#include "licht/shared/effects.h"
#include "licht/shared/frame.h"
#include "licht/shared/index.h"
#include "licht/spirv/sphere_light_comp.h"

namespace licht {
namespace {

using glm::dvec3;

struct Place {
    vec3 position;
    float error_bound = 1e-6F;
    vec3 normal;
    float reserved = 0.0F;
};

struct Answer {
    vec3 direction;
    float pdf;
    float looked_up;
    uint target;
    uint met;
    uint arrives;
};

struct Push {
    std::uint32_t count;
    std::uint32_t per_place;
};

void add(Scene& scene, Mesh mesh, std::uint32_t material, const mat4& transform = mat4(1.0F)) {
    mesh.material = material;
    scene.instances.push_back({"", static_cast<std::uint32_t>(scene.meshes.size()), transform});
    scene.meshes.push_back(std::move(mesh));
}

Mesh quad(const vec3& corner, const vec3& u, const vec3& v) {
    Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh icosahedron() {
    const float g = std::numbers::phi_v<float>;
    Mesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (vec3& p : mesh.positions) p /= std::sqrt(1.0F + g * g);
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return mesh;
}

mat4 ballAt(const vec3& centre, float radius) {
    return glm::rotate(glm::scale(glm::translate(mat4(1.0F), centre), vec3(radius)), 0.7F,
                       glm::normalize(vec3(1, 2, -1)));
}

constexpr vec3 kCentre{0, 2, 0};
constexpr float kRadius = 0.5F;

// A lamp (instance 1), a greater one behind it (2), a shining and a dark quad that hide parts of both, and
// one that cuts through the first, so that a walk may find what is behind its face before the face. The
// greater one shines on both sides, as a lamp alone does.
Scene lampScene(bool alone) {
    Scene scene;
    Material glow;
    glow.emission = vec3(3.0F);
    scene.materials = {Material{}, glow, glow};
    scene.materials[2].double_sided = true;
    add(scene, quad({-500, 500, 500}, {1000, 0, 0}, {0, 0, -1000}), 0);
    add(scene, icosahedron(), alone ? 2 : 1, ballAt(kCentre, kRadius));
    if (alone) return scene;
    add(scene, icosahedron(), 2, ballAt({0.3F, 4, 0.2F}, 1.2F));
    add(scene, quad({0.1F, 1.2F, -0.5F}, {0.2F, 0, 0}, {0, 0, 1}), 1);
    add(scene, quad({-0.6F, 1.3F, -0.1F}, {0.5F, 0, 0}, {0, 0, 0.2F}), 0);
    add(scene, quad({-0.6F, 1.8F, -0.6F}, {1.2F, 0.3F, 0}, {0, 0, 1.2F}), 0);
    return scene;
}

std::vector<Answer> ask(const Scene& scene, const std::vector<Place>& places, std::uint32_t per_place,
                        LightChoice lights) {
    gpu::Device& device = gpu::testDevice();
    const Effects effects = detectEffects(scene);
    EXPECT_TRUE(effects.has(kEffectLightSpheres));
    GpuScene::Options options;
    options.lights = lights;
    const GpuScene gpu_scene(device, scene, effects, options);
    FrameRecord frame{};
    gpu_scene.describe(frame);
    gpu::Buffer frame_buffer(device, "frame", sizeof(frame), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                             gpu::Memory::host_write);
    std::memcpy(frame_buffer.mapped(), &frame, sizeof(frame));
    gpu::SpecConstants constants = gpu_scene.constants();
    constants[kConstantSampler] = kSamplerRandom;
    test::Kernel kernel("sphere light", sphere_light_comp, constants);
    std::vector<gpu::BoundResource> resources = gpu_scene.resources();
    resources.push_back({"FrameBlock", &frame_buffer});
    const auto count = static_cast<std::uint32_t>(places.size()) * per_place;
    return kernel.run<Answer>(count, count, Push{count, per_place}, places, resources);
}

// Where a share of the cone and a turn around its axis place it, both in [0, 1).
void addTo(test::Histogram& histogram, const dvec3& direction, const dvec3& centre) {
    const dvec3 axis = glm::normalize(centre);
    const dvec3 across = glm::normalize(glm::cross(axis, dvec3(0.3, 0.1, 0.9)));
    const dvec3 w = glm::normalize(direction);
    const auto height = [](double sine2) { return sine2 / (1.0 + std::sqrt(1.0 - sine2)); };
    const dvec3 sideways = glm::cross(axis, w);
    const double sine2 = glm::dot(sideways, sideways);
    const double share = glm::dot(axis, w) > 0.0 ? height(std::min(sine2, 1.0)) : 2.0 - height(sine2);
    const double whole =
        height(static_cast<double>(kRadius) * static_cast<double>(kRadius) / glm::dot(centre, centre));
    const double turn = std::atan2(glm::dot(glm::cross(axis, across), w), glm::dot(across, w));
    histogram.add(share / whole, turn / (2.0 * std::numbers::pi) + 0.5);
}

// From a hundredth of the radius above the sphere to where it fills 1e-4 rad; there a direction is rounded by
// 6e-4 of that, which shifts 1e-3 of what a cell holds.
TEST(SphereLight, DirectionsFillTheConeEvenly) {
    constexpr std::uint32_t kPerPlace = 1U << 16U;
    std::vector<Place> places;
    for (const float distance : {1.01F, 2.0F, 30.0F, 2e4F})
        places.push_back({kCentre - kRadius * distance * glm::normalize(vec3(1, 2, 0.5F)), 0.0F, {0, 1, 0}});
    const std::vector<Answer> answers = ask(lampScene(true), places, kPerPlace, LightChoice::tree);
    for (std::size_t p = 0; p < places.size(); ++p) {
        test::Histogram histogram(8, 8);
        const dvec3 centre = dvec3(kCentre) - dvec3(places[p].position);
        std::size_t arrived = 0;
        for (std::size_t i = p * kPerPlace; i < (p + 1) * kPerPlace; ++i) {
            ASSERT_GT(answers[i].pdf, 0.0F);
            addTo(histogram, dvec3(answers[i].direction), centre);
            arrived += answers[i].arrives;
        }
        test::expectLikely("place " + std::to_string(p), histogram.counts(), histogram.uniform(),
                           static_cast<int>(places.size()));
        // The inner ball's share of the cone, and less than all of it.
        EXPECT_GT(arrived, kPerPlace * 0.6);
        EXPECT_LT(arrived, kPerPlace);
    }
}

class Choices : public testing::TestWithParam<LightChoice> {};

TEST_P(Choices, WhatArrivesIsMetFirstAndLookedUpAlike) {
    constexpr std::uint32_t kPerPlace = 1U << 14U;
    const std::vector<Place> places{{{0, 0, 0}, 1e-6F, {0, 1, 0}},
                                    {{0.4F, 1.1F, 0.1F}, 1e-6F, glm::normalize(vec3(-1, 2, 0))},
                                    {{0, 1.45F, 0}, 1e-6F, {0, 1, 0}},
                                    {{0.2F, 2.7F, 0.1F}, 1e-6F, {0, -1, 0}},
                                    {{-30, 5, 20}, 1e-4F, {1, 0, 0}}};
    const std::vector<Answer> answers = ask(lampScene(false), places, kPerPlace, GetParam());
    std::size_t arrived = 0;
    std::size_t blocked = 0;
    std::size_t passed = 0;
    for (const Answer& a : answers) {
        if (a.pdf <= 0.0F) continue;
        ASSERT_EQ(a.arrives != 0, a.met == a.target);
        if (a.target == kNoIndex) continue;
        arrived += a.arrives;
        blocked += a.met != a.target && a.met != kNoIndex ? 1 : 0;
        passed += a.met == kNoIndex ? 1 : 0;
        if (a.arrives != 0) {
            ASSERT_EQ(a.looked_up, a.pdf);
        }
    }
    for (const std::size_t count : {arrived, blocked, passed}) EXPECT_GT(count, answers.size() / 100);
}

INSTANTIATE_TEST_SUITE_P(SphereLight, Choices,
                         testing::Values(LightChoice::tree, LightChoice::power, LightChoice::uniform));

// Within the sphere, in front of a face, inside the mesh: not sampled, and found by scattering alone.
TEST(SphereLight, IsNotSampledFromInside) {
    constexpr std::uint32_t kPerPlace = 1024;
    std::vector<Place> places;
    const Mesh mesh = icosahedron();
    for (const float share : {0.0F, 0.4F, 0.9F, 0.999F}) {
        const uvec3 t = mesh.triangles[4];
        const vec3 out = glm::normalize(mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]);
        const vec3 world(ballAt(kCentre, kRadius) * vec4(share * out, 1.0F));
        places.push_back({world, 0.0F, -glm::normalize(glm::mat3(ballAt(kCentre, kRadius)) * out)});
    }
    for (const Answer& a : ask(lampScene(true), places, kPerPlace, LightChoice::tree)) {
        EXPECT_EQ(a.pdf, 0.0F);
        EXPECT_EQ(a.met, 1U);
        EXPECT_EQ(a.looked_up, 0.0F);
    }
}

}  // namespace
}  // namespace licht
