// Furniture and the things upon it.
#include <cmath>
#include <vector>

#include "samples/scenes/assembly.h"
#include "samples/scenes/gallery.h"
#include "samples/scenes/shapes.h"

namespace licht::gallery {
namespace {

Mesh vase(const char* name, std::uint32_t material, const std::vector<vec2>& outline) {
    return latheMesh(name, material, smoothProfile(outline, 6), 40);
}

void addRug(Scene& scene, const Materials& m) {
    const mat4 where = moved({-0.25F, 0.0F, -0.75F}, 0.06F);
    constexpr float kWide = 1.5F;
    constexpr float kDeep = 1.125F;
    constexpr float kPile = 0.014F;
    place(scene, boxMesh("rug edge", m.rug_edge, {-kWide, 0.0F, -kDeep}, {kWide, kPile, kDeep}), where);
    constexpr float kTop = kPile + 0.001F;
    place(scene,
          quadMesh("rug", m.rug, {-kWide, kTop, kDeep}, {kWide, kTop, kDeep}, {kWide, kTop, -kDeep},
                   {-kWide, kTop, -kDeep}),
          where);
}

void addTable(Scene& scene, const Materials& m) {
    const vec3 foot{-0.2F, 0.015F, -0.85F};
    constexpr float kTop = 0.40F;
    place(scene,
          grainAlong(latheMesh("table top", m.walnut,
                               smoothProfile({{0.0F, 0.0F},
                                              {0.50F, 0.0F},
                                              {0.55F, 0.012F},
                                              {0.56F, 0.022F},
                                              {0.55F, 0.032F},
                                              {0.53F, 0.035F},
                                              {0.0F, 0.035F}},
                                             3),
                               72),
                     2),
          moved(foot + vec3(0, kTop - 0.035F, 0)));
    for (int k = 0; k < 3; ++k) {
        const float angle = 2.0F * kPi * (static_cast<float>(k) + 0.25F) / 3.0F;
        const vec3 out{std::cos(angle), 0.0F, std::sin(angle)};
        placeBar(scene, "table leg", m.walnut, foot + 0.42F * out,
                 foot + 0.26F * out + vec3(0, kTop - 0.03F, 0), 0.018F);
    }
    const vec3 on = foot + vec3(0, kTop, 0);
    place(scene,
          vase("copper bowl", m.copper,
               {{0.0F, 0.0F},
                {0.06F, 0.0F},
                {0.065F, 0.012F},
                {0.15F, 0.05F},
                {0.19F, 0.11F},
                {0.185F, 0.112F},
                {0.14F, 0.06F},
                {0.05F, 0.028F},
                {0.0F, 0.024F}}),
          moved(on + vec3(0.22F, 0, 0.12F)));
    place(scene,
          vase("bottle", m.blue_ceramic,
               {{0.0F, 0.0F},
                {0.06F, 0.0F},
                {0.085F, 0.06F},
                {0.08F, 0.14F},
                {0.03F, 0.22F},
                {0.02F, 0.30F},
                {0.028F, 0.34F},
                {0.02F, 0.34F},
                {0.012F, 0.30F},
                {0.0F, 0.28F}}),
          moved(on + vec3(-0.22F, 0, -0.12F)));
    place(scene,
          vase("round vase", m.white_ceramic,
               {{0.0F, 0.0F},
                {0.05F, 0.0F},
                {0.10F, 0.06F},
                {0.10F, 0.12F},
                {0.04F, 0.17F},
                {0.035F, 0.185F},
                {0.028F, 0.185F},
                {0.03F, 0.165F},
                {0.0F, 0.12F}}),
          moved(on + vec3(-0.06F, 0, -0.26F)));
    place(scene, roundedBoxMesh("lower book", m.book_blue, {0.27F, 0.032F, 0.20F}, 0.006F, 1),
          moved(on + vec3(-0.2F, 0.016F, 0.2F), 0.35F));
    place(scene, roundedBoxMesh("upper book", m.book_cream, {0.23F, 0.026F, 0.17F}, 0.006F, 1),
          moved(on + vec3(-0.2F, 0.045F, 0.2F), 0.1F));
    place(scene, sphereMesh("gold sphere", m.gold, 0.05F, 40, 20), moved(on + vec3(-0.2F, 0.108F, 0.2F)));
}

void addArmchair(Scene& scene, const Materials& m) {
    // Its own frame looks along +Z.
    const mat4 where = moved({-1.95F, 0.0F, -1.75F}, 0.95F);
    const auto cushion = [&](const char* name, std::uint32_t material, const vec3& size, const vec3& centre,
                             float lean, float radius) {
        place(scene, roundedBoxMesh(name, material, size, radius, 5),
              where * glm::rotate(glm::translate(mat4(1.0F), centre), lean, vec3(1, 0, 0)));
    };
    cushion("seat", m.upholstery, {0.66F, 0.17F, 0.68F}, {0, 0.38F, 0.02F}, -0.06F, 0.07F);
    cushion("back", m.upholstery, {0.66F, 0.17F, 0.62F}, {0, 0.68F, -0.36F}, -1.28F, 0.07F);
    cushion("pillow", m.cushion, {0.42F, 0.14F, 0.34F}, {0.04F, 0.58F, -0.2F}, -1.2F, 0.065F);
    for (const float side : {-1.0F, 1.0F}) {
        const auto bar = [&](const vec3& from, const vec3& to, float radius) {
            const auto world = [&](const vec3& p) { return vec3(where * vec4(side * p.x, p.y, p.z, 1.0F)); };
            placeBar(scene, "armchair frame", m.oak, world(from), world(to), radius);
        };
        bar({0.38F, 0.0F, 0.36F}, {0.38F, 0.56F, 0.32F}, 0.02F);
        bar({0.38F, 0.0F, -0.48F}, {0.38F, 0.55F, -0.34F}, 0.02F);
        bar({0.38F, 0.28F, 0.34F}, {0.38F, 0.22F, -0.42F}, 0.018F);
        place(scene, roundedBoxMesh("arm rest", m.oak, {0.075F, 0.03F, 0.84F}, 0.014F, 2),
              where * glm::translate(mat4(1.0F), vec3(side * 0.38F, 0.57F, -0.02F)));
    }
    const auto world = [&](const vec3& p) { return vec3(where * vec4(p, 1.0F)); };
    placeBar(scene, "armchair frame", m.oak, world({-0.38F, 0.27F, 0.33F}), world({0.38F, 0.27F, 0.33F}),
             0.018F);
    placeBar(scene, "armchair frame", m.oak, world({-0.38F, 0.23F, -0.38F}), world({0.38F, 0.23F, -0.38F}),
             0.018F);
}

void addBench(Scene& scene, const Materials& m) {
    const vec3 middle{-0.55F, 0.0F, -4.22F};
    place(scene, grainAlong(roundedBoxMesh("bench", m.oak, {1.9F, 0.06F, 0.46F}, 0.015F, 2), 0),
          moved(middle + vec3(0, 0.39F, 0)));
    for (const float side : {-1.0F, 1.0F}) {
        place(scene, roundedBoxMesh("bench leg", m.oak, {0.06F, 0.37F, 0.42F}, 0.012F, 1),
              moved(middle + vec3(side * 0.82F, 0.185F, 0)));
    }
    place(scene, roundedBoxMesh("bench cushion", m.cushion, {0.9F, 0.09F, 0.44F}, 0.04F, 4),
          moved(middle + vec3(-0.42F, 0.465F, 0)));
    place(scene, roundedBoxMesh("red book", m.book_red, {0.24F, 0.03F, 0.17F}, 0.006F, 1),
          moved(middle + vec3(0.35F, 0.435F, 0), 0.2F));
    place(scene, roundedBoxMesh("blue book", m.book_blue, {0.22F, 0.035F, 0.16F}, 0.006F, 1),
          moved(middle + vec3(0.36F, 0.468F, 0), -0.1F));
    place(scene,
          vase("bench vase", m.terracotta,
               {{0.0F, 0.0F},
                {0.07F, 0.0F},
                {0.11F, 0.09F},
                {0.075F, 0.2F},
                {0.05F, 0.25F},
                {0.07F, 0.29F},
                {0.06F, 0.29F},
                {0.04F, 0.25F},
                {0.0F, 0.2F}}),
          moved(middle + vec3(0.72F, 0.42F, 0)));
}

void addSideboard(Scene& scene, const Materials& m) {
    // Along the right wall, its doors to the left.
    const vec3 middle{3.14F, 0.0F, -2.55F};
    place(scene, roundedBoxMesh("sideboard", m.walnut, {0.46F, 0.5F, 1.9F}, 0.015F, 2),
          moved(middle + vec3(0, 0.45F, 0)));
    for (int k = 0; k < 3; ++k) {
        const float z = 0.62F * (static_cast<float>(k) - 1.0F);
        place(scene, roundedBoxMesh("door", m.walnut, {0.02F, 0.44F, 0.59F}, 0.006F, 1),
              moved(middle + vec3(-0.235F, 0.45F, z)));
        place(scene, sphereMesh("knob", m.brass, 0.016F, 16, 8),
              moved(middle + vec3(-0.258F, 0.52F, z + 0.22F)));
    }
    for (const float x : {-0.17F, 0.17F}) {
        for (const float z : {-0.85F, 0.85F})
            placeBar(scene, "sideboard leg", m.brass, middle + vec3(x, 0, z), middle + vec3(x, 0.21F, z),
                     0.014F);
    }
    const vec3 on = middle + vec3(0, 0.7F, 0);
    place(scene,
          vase("tall vase", m.white_ceramic,
               {{0.0F, 0.0F},
                {0.06F, 0.0F},
                {0.09F, 0.1F},
                {0.10F, 0.22F},
                {0.05F, 0.34F},
                {0.035F, 0.42F},
                {0.05F, 0.46F},
                {0.04F, 0.46F},
                {0.025F, 0.42F},
                {0.0F, 0.36F}}),
          moved(on + vec3(0.02F, 0, 0.55F)));
    place(scene,
          vase("squat vase", m.blue_ceramic,
               {{0.0F, 0.0F},
                {0.08F, 0.0F},
                {0.12F, 0.07F},
                {0.10F, 0.14F},
                {0.05F, 0.17F},
                {0.05F, 0.19F},
                {0.04F, 0.19F},
                {0.04F, 0.17F},
                {0.0F, 0.12F}}),
          moved(on + vec3(-0.04F, 0, 0.27F)));
    place(scene, sphereMesh("copper sphere", m.copper, 0.075F, 40, 20),
          moved(on + vec3(-0.06F, 0.075F, 0.02F)));
}

}  // namespace

void addFurniture(Scene& scene, const Materials& m) {
    addRug(scene, m);
    addTable(scene, m);
    addArmchair(scene, m);
    addBench(scene, m);
    addSideboard(scene, m);
}

}  // namespace licht::gallery
