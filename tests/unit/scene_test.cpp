#include "licht/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "licht/core/error.h"
#include "licht/scene/describe.h"
#include "licht/scene/tangents.h"

namespace licht {
namespace {

/// A unit square in the xy plane, facing +Z, with texture coordinates: u to the right, v downward.
Scene squareScene() {
    Scene scene;
    scene.name = "square";
    scene.materials.resize(1);
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.normals.assign(4, vec3(0, 0, 1));
    mesh.uv_sets = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({"square", 0, mat4(1.0F)});
    return scene;
}

TEST(SceneBounds, FollowInstancesAndLeaveOutWhatIsNoPlace) {
    EXPECT_TRUE(sceneBounds(Scene{}).empty());
    Scene scene = squareScene();
    scene.instances[0].world_from_object = glm::translate(mat4(1.0F), vec3(2, 3, 4));
    scene.instances.push_back({"mirrored", 0, glm::scale(mat4(1.0F), vec3(-2, 1, 1))});
    scene.meshes[0].positions.emplace_back(kInfinity, 0.0F, 0.0F);  // named by no triangle
    scene.meshes[0].positions.emplace_back(std::nanf(""), 0.0F, 0.0F);
    scene.meshes[0].triangles.emplace_back(0, 1, 5);
    const Bounds bounds = sceneBounds(scene);
    EXPECT_EQ(bounds.lower, vec3(-2, 0, 0));
    EXPECT_EQ(bounds.upper, vec3(3, 4, 4));
}

/// The share of the half picture that the farthest corner reaches, and the nearest corner's depth.
std::pair<float, float> seenBy(const Camera& camera, const Bounds& bounds, float aspect) {
    const mat4 view_from_world = glm::inverse(camera.world_from_view);
    const float tan_y = std::tan(0.5F * camera.y_fov);
    float reach = 0.0F;
    float nearest = kInfinity;
    for (int i = 0; i < 8; ++i) {
        const vec3 corner((i & 1) != 0 ? bounds.upper.x : bounds.lower.x,
                          (i & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                          (i & 4) != 0 ? bounds.upper.z : bounds.lower.z);
        const vec4 p = view_from_world * vec4(corner, 1.0F);
        reach = std::max({reach, std::abs(p.x) / (-p.z * tan_y * aspect), std::abs(p.y) / (-p.z * tan_y)});
        nearest = std::min(nearest, -p.z);
    }
    return {reach, nearest};
}

TEST(FramingCamera, HoldsTheBoxWithTenPercentMargin) {
    const std::vector<Bounds> boxes{{vec3(-1), vec3(1)},
                                    {vec3(0, 0, 0), vec3(100, 1, 0)},
                                    {vec3(5, -3, 2), vec3(5.001F, -2.999F, 2.001F)},
                                    {vec3(-1e6F), vec3(2e6F, 1e5F, 1e3F)}};
    for (const Bounds& box : boxes) {
        for (const float aspect : {0.5F, 1.0F, 2.4F}) {
            const Camera camera = framingCamera(box, aspect);
            const auto [reach, nearest] = seenBy(camera, box, aspect);
            // Positions up to m metres out are rounded by m 2^-24 each; seen from a distance of about the
            // box's size s, that is m / s 2^-22 or less of the picture, twice that with the matrix inverse.
            const float out = std::max(glm::length(box.lower), glm::length(box.upper)) / box.radius();
            EXPECT_NEAR(reach, 0.9F, std::max(1.0F, out) * std::ldexp(1.0F, -20));
            EXPECT_GT(nearest, camera.z_near);
            EXPECT_GT(camera.z_near, 0.0F);
            EXPECT_GT(camera.world_from_view[3].z, box.centre().z);  // from the front
            EXPECT_GT(camera.world_from_view[3].y, box.centre().y);  // above
            EXPECT_GT(camera.world_from_view[3].x, box.centre().x);  // to the right
        }
    }
}

TEST(FramingCamera, IsSensibleForNothingAndForAPoint) {
    for (const Bounds& bounds : {Bounds{}, Bounds{vec3(1e7F), vec3(1e7F)}}) {
        const Camera camera = framingCamera(bounds, 0.0F);
        const vec3 centre = bounds.empty() ? vec3(0.0F) : bounds.centre();
        EXPECT_TRUE(isPlace(vec3(camera.world_from_view[3])));
        EXPECT_GT(glm::length(vec3(camera.world_from_view[3]) - centre), 0.0F);
        EXPECT_GT(camera.z_near, 0.0F);
    }
}

TEST(ConstantEnvironment, IsOneTexel) {
    const Environment sky = constantEnvironment(vec3(1, 2, 3));
    EXPECT_EQ(sky.radiance.width, 1);
    EXPECT_EQ(sky.radiance.height, 1);
    EXPECT_EQ(sky.radiance.texels, (std::vector<float>{1, 2, 3}));
}

TEST(ValidateScene, NamesTheObjectThatIsWrong) {
    EXPECT_NO_THROW(validateScene(Scene{}));
    EXPECT_NO_THROW(validateScene(squareScene()));
    const std::vector<std::pair<std::string, std::function<void(Scene&)>>> faults{
        {"mesh 0 'square'", [](Scene& s) { s.meshes[0].triangles[1].z = 4; }},
        {"mesh 0 'square'", [](Scene& s) { s.meshes[0].normals.pop_back(); }},
        {"mesh 0 'square'", [](Scene& s) { s.meshes[0].uv_sets[0].pop_back(); }},
        {"mesh 0 'square'", [](Scene& s) { s.meshes[0].material = 1; }},
        {"instance 0 'square'", [](Scene& s) { s.instances[0].mesh = 1; }},
        {"instance 0 'square'", [](Scene& s) { s.instances[0].world_from_object[3].x = kInfinity; }},
        {"material 0", [](Scene& s) { s.materials[0].slots[kSlotBaseColor].texture = 0; }},
        {"material 0", [](Scene& s) { s.materials[0].roughness = 1.5F; }},
        {"material 0", [](Scene& s) { s.materials[0].emission.y = std::nanf(""); }},
        {"texture 0 't'",
         [](Scene& s) {
             s.textures.push_back({"t", 2, 2, 8, std::vector<std::uint8_t>(15)});
         }},
        {"camera 0 'c'", [](Scene& s) { s.cameras.push_back({.name = "c", .y_fov = 4.0F}); }},
        {"light 0 'l'", [](Scene& s) { s.lights.push_back({.name = "l", .direction = vec3(0, 0, -2)}); }},
        {"light 0 'l'", [](Scene& s) { s.lights.push_back({.name = "l", .angular_diameter = 3.2F}); }},
        {"environment 0 'constant'",
         [](Scene& s) {
             s.environment = constantEnvironment(vec3(1));
             s.environment->radiance.texels.pop_back();
         }},
    };
    for (const auto& [object, spoil] : faults) {
        Scene scene = squareScene();
        spoil(scene);
        try {
            validateScene(scene);
            FAIL() << "accepted: " << object;
        } catch (const InputError& e) {
            EXPECT_NE(std::string(e.what()).find(object), std::string::npos) << e.what();
        }
    }
}

TEST(DeriveTangents, PointAlongGrowingUWithNormalCrossTangentUpInThePicture) {
    Scene scene = squareScene();
    Mesh& mesh = scene.meshes[0];
    deriveTangents(mesh, TextureSlot{});
    for (const vec4& t : mesh.tangents) {
        EXPECT_EQ(t, vec4(1, 0, 0, 1));  // cross(+Z, +X) = +Y is up in the picture
    }
    for (vec2& uv : mesh.uv_sets[0]) {
        uv.x = -uv.x;
    }
    deriveTangents(mesh, TextureSlot{});
    for (const vec4& t : mesh.tangents) {
        EXPECT_EQ(t, vec4(-1, 0, 0, -1));  // mirrored: cross(+Z, -X) * -1 = +Y
    }
}

TEST(DeriveTangents, FollowTheTextureTransform) {
    Scene scene = squareScene();
    TextureSlot slot;
    slot.u_from_uv = vec3(0, 1, 0);  // the picture turned by a quarter: u' = v, v' = -u
    slot.v_from_uv = vec3(-1, 0, 0);
    deriveTangents(scene.meshes[0], slot);
    for (const vec4& t : scene.meshes[0].tangents) {
        EXPECT_EQ(t, vec4(0, -1, 0, 1));  // u' = v grows downward; up in the picture is +X = cross(+Z, -Y)
    }
}

TEST(DeriveTangents, DegenerateCoordinatesGiveAnyFrame) {
    Scene scene = squareScene();
    Mesh& mesh = scene.meshes[0];
    mesh.uv_sets[0].assign(4, vec2(0.5F));
    mesh.normals = {{0, 0, 1}, {0, 0, -1}, glm::normalize(vec3(1, 2, 3)), {0, 0, 0}};
    deriveTangents(mesh, TextureSlot{});
    for (std::size_t i = 0; i < 4; ++i) {
        // Rounding to float: half an ulp in each of three components.
        EXPECT_NEAR(glm::length(vec3(mesh.tangents[i])), 1.0F, 2.0F * std::numeric_limits<float>::epsilon());
        EXPECT_NEAR(glm::dot(vec3(mesh.tangents[i]), mesh.normals[i]), 0.0F,
                    2.0F * std::numeric_limits<float>::epsilon());
    }
}

TEST(DescribeScene, SaysWhatIsThere) {
    Scene scene = squareScene();
    scene.notes.push_back({SceneNote::Kind::skipped, "mesh 7: points are not drawn"});
    scene.lights.push_back({.name = "lamp"});
    const std::string text = describeSceneText(scene);
    const std::string json = describeSceneJson(scene);
    for (const char* part :
         {"2 triangles", "'lamp' point", "skipped: mesh 7: points are not drawn", "light 'lamp' shines"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
    }
    for (const char* part : {"\"triangles\": 2", "\"kind\": \"skipped\"",
                             "\"evidence\": \"light 'lamp' shines\"", "\"environment\": null"}) {
        EXPECT_NE(json.find(part), std::string::npos) << part << " in\n" << json;
    }
}

}  // namespace
}  // namespace licht
