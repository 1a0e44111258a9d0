#include "samples/licht/orbit_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace licht {
namespace {

// A few float roundings of values of length up to ten.
constexpr float kTolerance = 64.0F * 10.0F / 16777216.0F;

const Bounds kBounds{vec3(-1.0F), vec3(1.0F)};

Camera from(const vec3& eye) {
    Camera camera;
    camera.world_from_view = glm::inverse(glm::lookAt(eye, vec3(0.0F), vec3(0, 1, 0)));
    return camera;
}

vec3 eyeOf(const OrbitCamera& orbit) {
    return vec3(orbit.camera().world_from_view[3]);
}
vec3 forwardOf(const OrbitCamera& orbit) {
    return -vec3(orbit.camera().world_from_view[2]);
}

void expectNear(const vec3& a, const vec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], kTolerance) << "component " << i;
}

TEST(OrbitCamera, StartsExactlyAtTheCamera) {
    const Camera camera = from({3, 2, 5});
    EXPECT_EQ(OrbitCamera(camera, kBounds).camera().world_from_view, camera.world_from_view);
    EXPECT_EQ(OrbitCamera(camera, Bounds{}).camera().world_from_view, camera.world_from_view);
}

TEST(OrbitCamera, OrbitKeepsTheDistanceAndTheAim) {
    OrbitCamera orbit(from({0, 0, 5}), kBounds);
    orbit.orbit(0.5F * kPi, 0.0F);
    expectNear(eyeOf(orbit), {5, 0, 0});
    expectNear(forwardOf(orbit), {-1, 0, 0});
    orbit.orbit(0.3F, -0.7F);
    EXPECT_NEAR(glm::length(eyeOf(orbit)), 5.0F, kTolerance);
    expectNear(forwardOf(orbit), -glm::normalize(eyeOf(orbit)));
}

TEST(OrbitCamera, StopsBeforeThePoles) {
    OrbitCamera orbit(from({0, 0, 5}), kBounds);
    for (int i = 0; i < 100; ++i) orbit.orbit(0.0F, -0.5F);
    EXPECT_LT(forwardOf(orbit).y, -0.99F);
    EXPECT_GT(orbit.camera().world_from_view[1].y, 0.0F) << "turned over";
    for (int i = 0; i < 100; ++i) orbit.orbit(0.0F, 0.5F);
    EXPECT_GT(forwardOf(orbit).y, 0.99F);
    EXPECT_GT(orbit.camera().world_from_view[1].y, 0.0F) << "turned over";
}

TEST(OrbitCamera, PanMovesTheAimWithTheHand) {
    const Camera camera = from({0, 0, 5});
    OrbitCamera orbit(camera, kBounds);
    orbit.pan(0.5F, 0.0F);
    // Half a picture height at the aim's distance, to the left so that the scene follows the hand to the
    // right.
    expectNear(eyeOf(orbit), {-5.0F * std::tan(0.5F * camera.y_fov), 0, 5});
    expectNear(forwardOf(orbit), {0, 0, -1});
}

TEST(OrbitCamera, DollyNeverReachesTheAim) {
    OrbitCamera orbit(from({0, 0, 5}), kBounds);
    orbit.dolly(0.5F);
    expectNear(eyeOf(orbit), {0, 0, 2.5F});
    for (int i = 0; i < 20; ++i) orbit.dolly(0.5F);
    EXPECT_GT(eyeOf(orbit).z, 0.0F);
}

TEST(OrbitCamera, DollyZoomsAnOrthographicCamera) {
    Camera camera = from({0, 0, 5});
    camera.kind = Camera::Kind::orthographic;
    OrbitCamera orbit(camera, kBounds);
    orbit.dolly(0.5F);
    EXPECT_FLOAT_EQ(orbit.camera().y_extent, 0.5F * camera.y_extent);
}

TEST(OrbitCamera, WalkGoesAlongItsOwnAxes) {
    OrbitCamera orbit(from({0, 0, 5}), kBounds);
    orbit.walk(0.2F, 0.4F);
    expectNear(eyeOf(orbit), {1, 0, 3});
}

TEST(OrbitCamera, IgnoresScaleAndMirroringOfItsNode) {
    Camera camera = from({0, 0, 5});
    camera.world_from_view *= glm::scale(mat4(1.0F), vec3(-2, 3, 4));
    OrbitCamera orbit(camera, kBounds);
    orbit.walk(0.0F, 0.0F);
    EXPECT_NEAR(glm::determinant(mat3(orbit.camera().world_from_view)), 1.0F, kTolerance);
    expectNear(forwardOf(orbit), {0, 0, -1});
}

}  // namespace
}  // namespace licht
