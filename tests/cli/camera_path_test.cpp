// From where each frame of a path is seen.
#include "samples/licht/camera_path.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "licht/core/error.h"
#include "samples/licht/path_file.h"

namespace licht {
namespace {

// A few roundings of floats near one.
constexpr float kTolerance = 16.0F / 16777216.0F;

vec3 eyeOf(const Camera& camera) {
    return vec3(camera.world_from_view[3]);
}
vec3 forwardOf(const Camera& camera) {
    return -vec3(camera.world_from_view[2]);
}
float angleBetween(const vec3& a, const vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Camera from(const vec3& eye, const vec3& forward, float y_fov = 0.5F) {
    Camera camera;
    camera.world_from_view = glm::inverse(glm::lookAt(eye, eye + forward, vec3(0, 1, 0)));
    camera.y_fov = y_fov;
    return camera;
}

void expectNear(const vec3& a, const vec3& b) {
    EXPECT_NEAR(glm::distance(a, b), 0.0F, kTolerance) << a.x << " " << a.y << " " << a.z;
}

bool sameView(const Camera& a, const Camera& b) {
    return a.world_from_view == b.world_from_view && a.y_fov == b.y_fov;
}

/// The axis of the turn from one camera to the other, as long as its angle.
vec3 turnBetween(const Camera& a, const Camera& b) {
    const mat3 turn = mat3(b.world_from_view) * glm::transpose(mat3(a.world_from_view));
    const vec3 sine = 0.5F * vec3(turn[1][2] - turn[2][1], turn[2][0] - turn[0][2], turn[0][1] - turn[1][0]);
    const float cosine = 0.5F * (turn[0][0] + turn[1][1] + turn[2][2] - 1.0F);
    return glm::normalize(sine) * std::atan2(glm::length(sine), cosine);
}

TEST(CameraKeys, EyesGoStraightAndTurnsKeepTheirAxis) {
    const vec3 first = glm::normalize(vec3(1.0F, 0.0F, -1.0F));
    const vec3 second = glm::normalize(vec3(-1.0F, 0.5F, -0.25F));
    const CameraKeys keys({{1.0, from(vec3(0.0F, 1.0F, 0.0F), first, 0.4F)},
                           {3.0, from(vec3(1.0F, -1.0F, 0.5F), second, 0.8F)}});
    // At its keys exactly.
    EXPECT_TRUE(sameView(keys.at(1.0), from(vec3(0.0F, 1.0F, 0.0F), first, 0.4F)));
    EXPECT_TRUE(sameView(keys.at(3.0), from(vec3(1.0F, -1.0F, 0.5F), second, 0.8F)));
    for (const float share : {0.25F, 0.5F, 0.9F}) {
        const Camera camera = keys.at(1.0 + 2.0 * static_cast<double>(share));
        expectNear(eyeOf(camera), glm::mix(vec3(0.0F, 1.0F, 0.0F), vec3(1.0F, -1.0F, 0.5F), share));
        EXPECT_NEAR(camera.y_fov, 0.4F + 0.4F * share, kTolerance);
        const mat3 axes(camera.world_from_view);
        for (int i = 0; i < 3; ++i) expectNear(glm::transpose(axes)[i], glm::inverse(axes)[i]);
        EXPECT_NEAR(glm::determinant(axes), 1.0F, kTolerance);
        expectNear(turnBetween(keys.at(1.0), camera), share * turnBetween(keys.at(1.0), keys.at(3.0)));
    }
}

TEST(CameraKeys, TurningIsEven) {
    // About the upward axis directions stay level, along the great circle.
    const auto heading = [](float angle) { return vec3(std::sin(angle), 0.0F, -std::cos(angle)); };
    const CameraKeys keys({{0.0, from(vec3(0.0F), heading(0.2F))}, {4.0, from(vec3(0.0F), heading(2.2F))}});
    for (const float time : {0.5F, 1.0F, 2.0F, 3.5F}) {
        const vec3 forward = forwardOf(keys.at(static_cast<double>(time)));
        expectNear(forward, heading(0.2F + 0.5F * time));
    }
    // The nearer way round: from 170 to 190 degrees by way of 180.
    const float degree = kPi / 180.0F;
    const CameraKeys across({{0.0, from(vec3(0.0F), heading(170.0F * degree))},
                             {1.0, from(vec3(0.0F), heading(-170.0F * degree))}});
    expectNear(forwardOf(across.at(0.5)), heading(kPi));
}

TEST(CameraKeys, ScaleAndMirroringOfNodesDoNotCount) {
    Camera scaled = from(vec3(0.0F), vec3(0, 0, -1));
    scaled.world_from_view = scaled.world_from_view * glm::scale(mat4(1.0F), vec3(3.0F, 3.0F, 0.5F));
    const CameraKeys keys({{0.0, scaled}, {1.0, from(vec3(0.0F), vec3(1, 0, 0))}});
    expectNear(forwardOf(keys.at(0.5)), glm::normalize(vec3(1, 0, -1)));
}

TEST(CameraKeys, RestsBeforeAndBehindAndWaitsForACut) {
    const Camera a = from(vec3(0.0F), vec3(0, 0, -1));
    const Camera b = from(vec3(1.0F), vec3(1, 0, 0));
    const Camera c = from(vec3(2.0F), vec3(0, 0, 1));
    const CameraKeys keys({{1.0, a}, {2.0, b, true}, {3.0, c}});
    for (const double time : {-1e9, 0.0, 1.0, 1.5, 1.999}) EXPECT_TRUE(sameView(keys.at(time), a)) << time;
    EXPECT_TRUE(sameView(keys.at(2.0), b));
    expectNear(eyeOf(keys.at(2.5)), vec3(1.5F));
    for (const double time : {3.0, 3.001, 1e9}) EXPECT_TRUE(sameView(keys.at(time), c)) << time;
    const CameraKeys one({{5.0, b}});
    for (const double time : {0.0, 5.0, 6.0}) EXPECT_TRUE(sameView(one.at(time), b)) << time;
}

TEST(CameraKeys, CutsAreInHalfOpenSpans) {
    const Camera camera = from(vec3(0.0F), vec3(0, 0, -1));
    const CameraKeys keys({{0.0, camera}, {1.0, camera, true}, {2.0, camera}, {3.0, camera, true}});
    EXPECT_TRUE(keys.cutsBetween(0.0, 1.0));
    EXPECT_FALSE(keys.cutsBetween(1.0, 2.0));
    EXPECT_TRUE(keys.cutsBetween(0.5, 1.5));
    EXPECT_FALSE(keys.cutsBetween(0.0, 0.999));
    EXPECT_FALSE(keys.cutsBetween(1.0, 1.0));
    EXPECT_TRUE(keys.cutsBetween(1.0, 5.0));
    EXPECT_FALSE(keys.cutsBetween(3.0, 1e9));
    EXPECT_FALSE(keys.cutsBetween(-5.0, 0.0));
}

TEST(PathFiles, SpeakOfTheFilesWorldAndOfTheChosenCamera) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("licht_path_" + std::to_string(::getpid()) + ".json");
    std::ofstream(file) << R"({"keys": [{"time": 2, "eye": [103, 0, 4], "target": [100, 0, 4]},
        {"time": 3, "eye": [100, 0, 0], "target": [100, -1, 0], "up": [3, 0, 0], "yfov": 90}]})";
    Scene scene;
    scene.origin = glm::dvec3(100.0, 0.0, 0.0);  // was moved to zero
    Camera start = from(vec3(9.0F), vec3(0, 0, -1), 0.25F);
    start.z_far = 77.0F;
    const CameraKeys keys = readPathFile(file, scene, start);
    std::filesystem::remove(file);
    expectNear(eyeOf(keys.at(2.0)), vec3(3, 0, 4));
    expectNear(forwardOf(keys.at(2.0)), vec3(-1, 0, 0));
    expectNear(vec3(keys.at(2.0).world_from_view[1]), vec3(0, 1, 0));
    EXPECT_EQ(keys.at(2.0).y_fov, 0.25F);
    EXPECT_EQ(keys.at(2.0).z_far, 77.0F);
    expectNear(forwardOf(keys.at(3.0)), vec3(0, -1, 0));
    expectNear(vec3(keys.at(3.0).world_from_view[1]), vec3(1, 0, 0));
    EXPECT_NEAR(keys.at(3.0).y_fov, 0.5F * kPi, kTolerance);
}

/// Of a box 2 m to either side that the camera sees from 10 m before its middle.
struct Box {
    NamedScene source;
    Shot shot{from(vec3(0.0F, 0.0F, 10.0F), vec3(0, 0, -1)), "0", uvec2(16, 16)};
    Box() {
        Mesh mesh;
        mesh.positions = {vec3(-2.0F), vec3(2.0F), vec3(2.0F, -2.0F, 2.0F)};
        mesh.triangles = {uvec3(0, 1, 2)};
        source.scene.meshes = {mesh};
        source.scene.materials.emplace_back();
        source.scene.instances.emplace_back();
    }
    [[nodiscard]] std::vector<PathFrame> follow(const std::string& path, std::uint32_t frames,
                                                double rate) const {
        return followPath({path, frames, rate}, source, shot);
    }
};

TEST(BuiltinPaths, BeginExactlyAtTheCamera) {
    Box box;
    // As a node may carry it.
    box.shot.camera = from(vec3(3.0F, 2.0F, 9.0F), vec3(-0.3F, -0.2F, -1.0F));
    box.shot.camera.world_from_view *= glm::scale(mat4(1.0F), vec3(3.0F));
    ASSERT_EQ(builtinPaths().size(), 5U);
    for (const BuiltinPath& path : builtinPaths()) {
        const std::vector<PathFrame> frames = box.follow(std::string(path.name), 9, 24.0);
        ASSERT_EQ(frames.size(), 9U);
        EXPECT_TRUE(sameView(frames[0].camera, box.shot.camera)) << path.name;
        EXPECT_EQ(sameView(frames[8].camera, box.shot.camera), path.name == "rest") << path.name;
    }
}

TEST(BuiltinPaths, OrbitSwingsFifteenDegreesInASecond) {
    const Box box;
    const std::vector<PathFrame> frames = box.follow("orbit", 5, 1.0);
    const float swing = 15.0F * kPi / 180.0F;
    expectNear(eyeOf(frames[1].camera) / 10.0F, vec3(std::sin(swing), 0.0F, std::cos(swing)));
    expectNear(forwardOf(frames[1].camera), -vec3(std::sin(swing), 0.0F, std::cos(swing)));
    expectNear(eyeOf(frames[3].camera) / 10.0F, vec3(-std::sin(swing), 0.0F, std::cos(swing)));
    expectNear(eyeOf(frames[4].camera) / 10.0F, vec3(0, 0, 1));
}

TEST(BuiltinPaths, StrafeWalksATenthOfTheDistance) {
    const Box box;
    const std::vector<PathFrame> frames = box.follow("strafe", 8, 2.0);
    expectNear(eyeOf(frames[2].camera) / 10.0F, vec3(0.1F, 0.0F, 1.0F));
    expectNear(eyeOf(frames[1].camera) / 10.0F, vec3(0.1F * std::sqrt(0.5F), 0.0F, 1.0F));
    expectNear(eyeOf(frames[6].camera) / 10.0F, vec3(-0.1F, 0.0F, 1.0F));
    for (const PathFrame& frame : frames) expectNear(forwardOf(frame.camera), vec3(0, 0, -1));
}

TEST(BuiltinPaths, CutComesHalfWay) {
    const Box box;
    for (const auto& [frames, second_half] : {std::pair(6U, 3U), std::pair(7U, 4U)}) {
        const std::vector<PathFrame> path = box.follow("cut", frames, 24.0);
        for (std::uint32_t i = 0; i < frames; ++i) {
            EXPECT_EQ(path[i].change == ViewChange::cut, i == second_half) << i;
            EXPECT_TRUE(sameView(path[i].camera, path[i < second_half ? 0 : second_half].camera)) << i;
        }
        EXPECT_NEAR(angleBetween(forwardOf(path[0].camera), forwardOf(path[second_half].camera)),
                    40.0F * kPi / 180.0F, kTolerance);
    }
}

TEST(BuiltinPaths, StillMoveStillMovesInItsSecondThird) {
    const Box box;
    const std::vector<PathFrame> path = box.follow("still-move-still", 9, 8.0);
    const std::vector<PathFrame> orbit = box.follow("orbit", 9, 8.0);
    for (std::size_t i = 0; i < path.size(); ++i)
        expectNear(eyeOf(path[i].camera) / 10.0F, eyeOf(orbit[i < 3 ? 0 : i < 6 ? i - 3 : 3].camera) / 10.0F);
    EXPECT_TRUE(sameView(path[7].camera, path[8].camera));
}

TEST(Paths, RefuseWhatHasNoNameAndViewsThatCannotBeDrawn) {
    Box box;
    for (const char* bad : {"", "Orbit", "orbit ", "json", "spiral"})
        EXPECT_THROW(static_cast<void>(box.follow(bad, 1, 1.0)), InputError) << bad;
    box.shot.camera.y_fov = 1e-7F;
    EXPECT_THROW(static_cast<void>(box.follow("orbit", 1, 1.0)), InputError);
    EXPECT_TRUE(isPathFile({"a/turn.json"}));
    EXPECT_TRUE(isPathFile({"TURN.JSON"}));
    for (const BuiltinPath& path : builtinPaths()) EXPECT_FALSE(isPathFile({std::string(path.name)}));
}

}  // namespace
}  // namespace licht
