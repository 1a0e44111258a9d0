// Spheres of many sizes above a ground. Their number and their tessellation grow together with the triangles.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"
#include "samples/scenes/pattern.h"
#include "samples/scenes/shapes.h"
#include "samples/scenes/tessellation.h"

namespace licht {
namespace {

constexpr std::uint32_t kSeed = 2017;
constexpr float kField = 9.5F;  // radius of the disc on which they lie, metres
constexpr float kSmallest = 0.12F;
constexpr float kLargest = 1.7F;

struct Ball {
    vec3 centre;
    float radius;
};

/// `i` numbers the attempt, `what` what is drawn.
float drawn(std::uint32_t i, std::uint32_t what) {
    return hashed(i, what, kSeed);
}

/// Large ones first; one that would meet another is drawn anew, and smaller after many failures.
std::vector<Ball> arrangeBalls(std::size_t count) {
    std::vector<Ball> balls;
    float shrink = 1.0F;
    for (std::uint32_t attempt = 0; balls.size() < count; ++attempt) {
        const float rank = static_cast<float>(balls.size() + 1);
        const float radius = std::max(kLargest / std::pow(rank, 0.45F), kSmallest) * shrink;
        const float angle = 2.0F * kPi * drawn(attempt, 0);
        const float distance = kField * std::sqrt(drawn(attempt, 1));
        // Half of them lie on the ground, the others float.
        const float height = drawn(attempt, 2) < 0.5F ? 0.0F : 4.5F * drawn(attempt, 3);
        const Ball ball{{distance * std::cos(angle), radius + height, distance * std::sin(angle)}, radius};
        const bool free = std::none_of(balls.begin(), balls.end(), [&](const Ball& other) {
            return glm::distance(ball.centre, other.centre) < 1.02F * (ball.radius + other.radius);
        });
        if (free)
            balls.push_back(ball);
        else
            shrink *= 0.9999F;
    }
    return balls;
}

Material paint(std::string name, const vec3& colour, float roughness, float metallic) {
    Material material;
    material.name = std::move(name);
    material.base_color = vec4(colour, 1.0F);
    material.roughness = roughness;
    material.metallic = metallic;
    return material;
}

std::vector<Mesh> ballMeshes(Scene& scene) {
    const std::array paints{paint("plaster", {0.74F, 0.72F, 0.68F}, 0.9F, 0.0F),
                            paint("brick", {0.58F, 0.16F, 0.08F}, 0.35F, 0.0F),
                            paint("teal", {0.05F, 0.30F, 0.33F}, 0.3F, 0.0F),
                            paint("ochre", {0.72F, 0.42F, 0.08F}, 0.5F, 0.0F),
                            paint("ink", {0.05F, 0.07F, 0.20F}, 0.25F, 0.0F),
                            paint("brass", {0.88F, 0.66F, 0.34F}, 0.3F, 1.0F)};
    std::vector<Mesh> meshes;
    for (const Material& material : paints) {
        Mesh mesh;
        mesh.name = material.name;
        mesh.material = addMaterial(scene, material);
        mesh.uv_sets.resize(1);
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

void addLamp(Scene& scene) {
    Material glow = paint("lamp", vec3(0.0F), 1.0F, 0.0F);
    glow.emission = vec3(46.0F, 42.0F, 36.0F);
    const std::uint32_t material = addMaterial(scene, glow);
    place(scene, quadMesh("lamp", material, {-5, 13, -9}, {3, 13, -9}, {3, 13, -3}, {-5, 13, -3}));
    scene.environment = paintSky("dusk", 64, 32, [](const vec3& direction, float) {
        return glm::mix(vec3(0.55F, 0.50F, 0.48F), vec3(0.16F, 0.24F, 0.42F),
                        softStep(-0.1F, 0.7F, direction.y));
    });
}

}  // namespace

Scene makeSpheres(std::uint64_t triangles) {
    Scene scene;
    scene.name = "spheres";
    constexpr std::uint64_t kRest = 4;  // ground and lamp
    std::uint64_t left = triangles - kRest;
    // A thousandth power of two: 300,000 triangles make 300 spheres of 1,000, ten million 1,700 of 5,800.
    const auto count = static_cast<std::size_t>(
        std::max(8.0, 300.0 * std::sqrt(static_cast<double>(triangles) / 300'000.0)));
    std::vector<Mesh> meshes = ballMeshes(scene);
    const std::vector<Ball> balls = arrangeBalls(count);
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const SphereCut cut = cutSphere(left / (balls.size() - i));
        left -= std::min(left, cut.triangles());
        Mesh& mesh = meshes[i % meshes.size()];
        appendMesh(mesh, sphereMesh("", mesh.material, balls[i].radius, cut.segments, cut.rings),
                   moved(balls[i].centre, static_cast<float>(i)));
    }
    for (Mesh& mesh : meshes) place(scene, std::move(mesh));
    constexpr float kGround = 60.0F;
    const std::uint32_t ground = addMaterial(scene, paint("ground", vec3(0.42F, 0.40F, 0.38F), 0.8F, 0.0F));
    place(scene, quadMesh("ground", ground, {-kGround, 0, kGround}, {kGround, 0, kGround},
                          {kGround, 0, -kGround}, {-kGround, 0, -kGround}));
    addLamp(scene);
    scene.cameras.push_back(lookingCamera("camera", {1.5F, 4.8F, 15.0F}, {0.0F, 1.7F, 0.0F}, 0.72F));
    return scene;
}

}  // namespace licht
