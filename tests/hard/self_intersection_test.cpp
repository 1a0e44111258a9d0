// A ray that leaves a surface does not meet it again, at any size and place, and meets what is 4e-5 away.
// The points, the offset and the rays are the path tracer's own: surfaceAt(), offsetOrigin(), traceNearest().
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>

#include "hard.h"
#include "licht/gpu/commands.h"
#include "licht/on_device/gpu_scene.h"
#include "licht/shared/effects.h"
#include "licht/shared/frame.h"
#include "licht/spirv/self_intersection_comp.h"
#include "samples/scenes/assembly.h"
#include "support/gpu_test.h"
#include "support/render_test.h"

namespace licht {
namespace {

using test::Random;

struct Question {
    vec3 direction;
    std::uint32_t triangle;
    float b1, b2;
    std::uint32_t instance, primitive;
};
struct Push {
    std::uint32_t ray_count;
};
struct Answer {
    std::uint32_t own_plane, instance, primitive;
    float error_bound;
};

/// One instance whose primitives are these triangles.
Scene sceneOf(const std::vector<BvhTriangle>& triangles) {
    Scene scene;
    scene.materials = {lambert(0.5F)};
    scene.materials[0].double_sided = true;
    licht::Mesh mesh;
    mesh.name = "triangles";
    for (const BvhTriangle& t : triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {t.v0, t.v1, t.v2});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    place(scene, std::move(mesh));
    return scene;
}

class Leaver {
public:
    explicit Leaver(const std::vector<BvhTriangle>& triangles)
        : scene_(sceneOf(triangles)),
          effects_(detectEffects(scene_)),
          gpu_scene_(gpu::testDevice(), scene_, effects_, {}),
          program_(gpu::Program::compute(gpu::testDevice(), "leave", self_intersection_comp,
                                         gpu_scene_.constants())) {
        FrameRecord frame{};
        gpu_scene_.describe(frame);
        frame_ = gpu::uploadBuffer(gpu::testDevice(), "frame", std::span<const FrameRecord>(&frame, 1),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    }

    std::vector<Answer> leave(const std::vector<Question>& questions) {
        gpu::Device& device = gpu::testDevice();
        const gpu::Buffer input = gpu::uploadBuffer(device, "questions", std::span<const Question>(questions),
                                                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        const gpu::Buffer output(device, "answers", questions.size() * sizeof(Answer),
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                 gpu::Memory::device);
        std::vector<gpu::BoundResource> resources = gpu_scene_.resources();
        resources.push_back({"FrameBlock", &frame_});
        resources.push_back({"QuestionBlock", &input});
        resources.push_back({"AnswerBlock", &output});
        const gpu::Bindings bindings(device, program_, resources);
        const auto count = static_cast<std::uint32_t>(questions.size());
        gpu::Commands commands(device);
        commands.begin();
        commands.dispatch("leave", {program_, bindings}, Push{count}, {count});
        commands.submit();
        commands.wait();
        const std::vector<std::byte> bytes = gpu::readBuffer(device, output);
        std::vector<Answer> answers(questions.size());
        std::memcpy(answers.data(), bytes.data(), bytes.size());
        return answers;
    }

private:
    Scene scene_;
    Effects effects_;
    GpuScene gpu_scene_;
    gpu::Program program_;
    gpu::Buffer frame_;
};

float anyMagnitude(Random& random) {
    const float size = std::pow(10.0F, random.uniform(-8.0F, 8.0F));
    return random.index(2) == 0 ? size : -size;
}

vec3 anyPoint(Random& random) {
    return {anyMagnitude(random), anyMagnitude(random), anyMagnitude(random)};
}

BvhTriangle anyTriangle(Random& random) {
    return {anyPoint(random), anyPoint(random), anyPoint(random)};
}

/// Small against its distance from the origin, by 1 to 1e-5.
BvhTriangle farTriangle(Random& random) {
    const vec3 at = anyPoint(random);
    const float size = glm::length(at) * std::pow(10.0F, random.uniform(-5.0F, 0.0F));
    return {at + random.inCube(size), at + random.inCube(size), at + random.inCube(size)};
}

/// How many of a million rays meet the triangle again that they leave, asked alone or in the scene: a
/// thousand triangles, hit from somewhere, each left in a thousand random directions on both sides (after the
/// test of Pharr, Jakob, Humphreys 2023, Physically Based Rendering, 4th edition).
std::size_t metAgain(BvhTriangle (*make)(Random&), std::uint32_t seed) {
    Random random(seed);
    std::vector<BvhTriangle> triangles;
    std::vector<Question> questions;
    constexpr std::size_t kTriangles = 1'000;
    constexpr std::size_t kRays = 1'000;
    while (triangles.size() < kTriangles) {
        const BvhTriangle t = make(random);
        const vec3 origin = anyPoint(random);
        float u = random.uniform(0.0F, 1.0F);
        float v = random.uniform(0.0F, 1.0F);
        if (u + v > 1.0F) {
            u = 1.0F - u;
            v = 1.0F - v;
        }
        const vec3 target = (1.0F - u - v) * t.v0 + u * t.v1 + v * t.v2;
        const auto hit = intersectTriangle({origin, target - origin}, t);
        if (!hit) {
            continue;  // needles are easily missed
        }
        const auto index = static_cast<std::uint32_t>(triangles.size());
        triangles.push_back(t);
        for (std::size_t i = 0; i < kRays; ++i) {
            questions.push_back({random.direction(), index, hit->b1, hit->b2, 0, index});
        }
    }
    const std::vector<Answer> answers = Leaver(triangles).leave(questions);
    std::size_t alone = 0;
    std::size_t within_scene = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        alone += answers[i].own_plane;
        within_scene += answers[i].instance == 0 && answers[i].primitive == questions[i].primitive ? 1U : 0U;
    }
    std::cout << "met again alone " << alone << ", in the scene " << within_scene << ", of " << answers.size()
              << " rays\n";
    return alone + within_scene;
}

// Coordinates 10^U(-8, 8): mostly needles.
TEST(SelfIntersection, RaysThatLeaveATriangleOfAnyShapeDoNotMeetIt) {
    EXPECT_EQ(metAgain(anyTriangle, 1), 0U);
}

// Here the rounding of the point is a share of its coordinates and much of the triangle.
TEST(SelfIntersection, RaysThatLeaveATriangleFarFromTheOriginDoNotMeetIt) {
    EXPECT_EQ(metAgain(farTriangle, 3), 0U);
}

// The offset must not step over what is near: of two spheres of radius 1 and 1 + 4e-5, rays into the one see
// the other.
TEST(SelfIntersection, ASurface4e_5AwayIsSeen) {
    const test::Mesh inner = test::sphere(vec3(0.0F), 1.0F, 64, 128);
    std::vector<BvhTriangle> triangles = inner.triangles;
    for (const BvhTriangle& t : inner.triangles) {
        constexpr float kOuter = 1.0F + 4e-5F;
        triangles.push_back({t.v0 * kOuter, t.v1 * kOuter, t.v2 * kOuter});
    }
    const std::size_t half = inner.triangles.size();
    Random random(2);
    std::vector<Question> questions;
    for (int i = 0; i < 200'000; ++i) {
        const std::uint32_t triangle = random.index(triangles.size());
        const BvhTriangle& t = triangles[triangle];
        // Inward from the outer one, outward from the inner one, within 60 degrees of the normal: a step of
        // at most 2 * 4e-5 sideways, so that rays that start 1e-3 of the triangle inside stay below it.
        vec3 normal = glm::normalize(glm::cross(t.v1 - t.v0, t.v2 - t.v0));
        normal = glm::dot(normal, t.v0) > 0.0F ? normal : -normal;
        vec3 direction = random.direction();
        const float side = triangle < half ? 1.0F : -1.0F;
        if (side * glm::dot(direction, normal) < 0.5F) {
            continue;
        }
        questions.push_back({direction, triangle, 0.3F, 0.4F, 0, triangle});
    }
    const std::vector<Answer> answers = Leaver(triangles).leave(questions);
    std::size_t stepped_over = 0;
    float largest = 0.0F;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const std::size_t other = (questions[i].triangle + half) % triangles.size();
        stepped_over += answers[i].instance == 0 && answers[i].primitive == other ? 0U : 1U;
        largest = std::max(largest, answers[i].error_bound);
    }
    std::cout << questions.size() << " rays, largest offset " << largest << '\n';
    EXPECT_GT(questions.size(), 10'000U);
    EXPECT_EQ(stepped_over, 0U);
}

}  // namespace
}  // namespace licht
