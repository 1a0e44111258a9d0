// Pictures, sculpture and the mirror.
#include "samples/scenes/assembly.h"
#include "samples/scenes/gallery.h"
#include "samples/scenes/shapes.h"

namespace licht::gallery {
namespace {

/// A framed picture in a frame of its own that faces +Z; the wall is z = 0.
void addFramed(Scene& scene, std::uint32_t picture, std::uint32_t frame, std::uint32_t mount,
               const vec2& size, float margin, const mat4& where) {
    const vec2 half = 0.5F * size;
    const vec2 outer = half + margin;
    constexpr float kDepth = 0.04F;
    constexpr float kBar = 0.03F;
    const auto box = [&](std::uint32_t material, const vec3& lower, const vec3& upper) {
        place(scene, boxMesh("picture frame", material, lower, upper), where);
    };
    box(mount, {-outer, 0.002F}, {outer, 0.015F});
    box(frame, {-outer.x - kBar, -outer.y - kBar, 0.001F}, {-outer.x, outer.y + kBar, kDepth});
    box(frame, {outer.x, -outer.y - kBar, 0.001F}, {outer.x + kBar, outer.y + kBar, kDepth});
    box(frame, {-outer.x, -outer.y - kBar, 0.001F}, {outer.x, -outer.y, kDepth});
    box(frame, {-outer.x, outer.y, 0.001F}, {outer.x, outer.y + kBar, kDepth});
    constexpr float kPaper = 0.016F;
    place(scene,
          quadMesh("picture", picture, {-half.x, -half.y, kPaper}, {half.x, -half.y, kPaper},
                   {half.x, half.y, kPaper}, {-half.x, half.y, kPaper}),
          where);
}

}  // namespace

void addArt(Scene& scene, const Materials& m) {
    const float back = kRoom.lower.z;
    const float right = kRoom.upper.x;
    addFramed(scene, m.picture, m.oak, m.passepartout, {1.65F, 1.16F}, 0.07F, moved({-0.55F, 1.68F, back}));

    // A round mirror above the sideboard.
    const mat4 upright = glm::rotate(moved({right, 1.62F, -2.55F}), 0.5F * kPi, vec3(0, 0, 1));
    place(scene,
          latheMesh(
              "mirror", m.mirror,
              {{0.0F, 0.0F}, {0.42F, 0.0F}, {0.42F, 0.0F}, {0.42F, 0.012F}, {0.42F, 0.012F}, {0.0F, 0.012F}},
              72),
          upright);
    place(scene, torusMesh("mirror rim", m.brass, 0.43F, 0.018F, 72, 12), upright);

    // The sculpture.
    const vec3 foot{1.12F, 0.0F, -3.45F};
    place(scene, roundedBoxMesh("plinth", m.plinth, {0.46F, 0.95F, 0.46F}, 0.012F, 2),
          moved(foot + vec3(0, 0.475F, 0), 0.3F));
    place(scene, coneMesh("sculpture base", m.steel, 0.12F, 0.12F, 0.02F, 40),
          moved(foot + vec3(0, 0.95F, 0)));
    placeBar(scene, "sculpture pin", m.steel, foot + vec3(0, 0.96F, 0), foot + vec3(0, 1.06F, 0), 0.012F);
    const TorusKnot knot{2.0F, 3.0F, 0.17F, 0.075F, 0.042F};
    place(scene, torusKnotMesh("sculpture", m.copper, knot, 256, 24),
          glm::rotate(moved(foot + vec3(0, 1.32F, 0), 0.35F), 0.5F * kPi, vec3(1, 0, 0)));
}

}  // namespace licht::gallery
