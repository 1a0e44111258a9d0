// A long dark hall and its lamps: every place is lit by the few lamps near it, most lamps are far from it or
// hidden. The count of triangles is that of the lamps alone.
#include "samples/scenes/lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"
#include "samples/scenes/pattern.h"
#include "samples/scenes/shapes.h"

namespace licht {
namespace {

using namespace lamps;

constexpr std::uint32_t kSeed = 1971;
constexpr vec3 kEye{0.55F, 1.7F, -1.9F};
constexpr float kFreeAroundEye = 1.6F;
/// The hall grows with the count of lamps, so that each place keeps its few.
constexpr double kLampsInBay = 17.0;
constexpr std::uint32_t kFewestBays = 6;
constexpr std::uint32_t kMostBays = 60;

struct Lamp {
    Kind kind;
    std::uint32_t triangles;
};

/// Ten kinds of lamps in turn, until that many triangles are used up; about one lamp for every 15.
std::vector<Lamp> chooseLamps(std::uint64_t triangles) {
    constexpr std::array<Lamp, 10> kTurn{{{Kind::panel, 2},
                                          {Kind::sphere, 20},
                                          {Kind::strip, 2},
                                          {Kind::shards, 7},
                                          {Kind::panel, 2},
                                          {Kind::sphere, 80},
                                          {Kind::strip, 2},
                                          {Kind::shards, 11},
                                          {Kind::panel, 2},
                                          {Kind::sphere, 20}}};
    std::vector<Lamp> chosen;
    for (std::uint64_t left = triangles; left > 0; left -= chosen.back().triangles) {
        const Lamp next = kTurn[chosen.size() % kTurn.size()];
        const std::uint32_t few = kTurn.back().triangles - 1;
        chosen.push_back(
            next.triangles <= left
                ? next
                : Lamp{Kind::shards, static_cast<std::uint32_t>(std::min<std::uint64_t>(left, few))});
    }
    return chosen;
}

/// Uniform in [0, 1) for lamp i.
float drawn(std::uint32_t i, std::uint32_t what) {
    return hashed(i, what, kSeed);
}

/// Half length and half width of what is flat, radius and radius of what is round.
vec2 sizeOf(const Lamp& lamp, std::uint32_t i) {
    const float t = drawn(i, 0);
    switch (lamp.kind) {
        case Kind::panel:
            return glm::mix(0.1F, 0.28F, t) * vec2(1.0F, glm::mix(0.5F, 1.0F, drawn(i, 1)));
        case Kind::strip:
            return {glm::mix(0.4F, 0.7F, t), glm::mix(0.025F, 0.06F, drawn(i, 1))};
        case Kind::sphere:
            return vec2(lamp.triangles > 20 ? glm::mix(0.14F, 0.24F, t) : glm::mix(0.05F, 0.12F, t));
        case Kind::shards:
            break;
    }
    return vec2(glm::mix(0.15F, 0.28F, t));
}

/// Keeps lamps apart; a grid of cells as wide as the largest of them.
class Occupied {
public:
    bool add(const vec3& centre, float radius) {
        const auto [x, y, z] = cellOf(centre);
        for (int i = 0; i < 27; ++i) {
            const auto near = balls_.find({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1});
            if (near == balls_.end()) continue;
            for (const vec4& ball : near->second)
                if (glm::distance(vec3(ball), centre) < ball.w + radius) return false;
        }
        balls_[{x, y, z}].emplace_back(centre, radius);
        return true;
    }

private:
    using Cell = std::tuple<int, int, int>;
    static constexpr float kCell = 1.6F;
    static Cell cellOf(const vec3& p) {
        const vec3 cell = glm::floor(p / kCell);
        return {static_cast<int>(cell.x), static_cast<int>(cell.y), static_cast<int>(cell.z)};
    }
    std::map<Cell, std::vector<vec4>> balls_;
};

/// Materials that only emit, one for each colour, strength and number of sides.
class Glows {
public:
    explicit Glows(Scene& scene) : scene_(scene) {}

    /// Steps are half a stop, so that many lamps share few materials.
    std::uint32_t material(std::uint32_t colour, int step, bool double_sided) {
        const auto [found, fresh] = known_.try_emplace({colour, step, double_sided}, 0U);
        if (fresh) {
            const auto& [name, tint] = kColours[colour];
            Material glow;
            glow.name = std::string(name) + " " + std::to_string(step) + (double_sided ? " both sides" : "");
            glow.base_color = vec4(0, 0, 0, 1);
            glow.metallic = 0.0F;
            glow.specular = 0.0F;
            glow.emission = std::exp2(0.5F * static_cast<float>(step)) * tint;
            glow.double_sided = double_sided;
            found->second = addMaterial(scene_, std::move(glow));
        }
        return found->second;
    }

    /// Warm more often than cool, cool more often than saturated ones.
    static std::uint32_t colour(float t) {
        const auto last = static_cast<float>(kColours.size());
        return static_cast<std::uint32_t>(last * std::pow(t, 1.2F));
    }

private:
    static constexpr std::array<std::pair<const char*, vec3>, 9> kColours{{{"candle", {1.0F, 0.50F, 0.16F}},
                                                                           {"bulb", {1.0F, 0.67F, 0.35F}},
                                                                           {"amber", {1.0F, 0.36F, 0.05F}},
                                                                           {"daylight", {0.75F, 0.88F, 1.0F}},
                                                                           {"ice", {0.30F, 0.62F, 1.0F}},
                                                                           {"teal", {0.05F, 0.80F, 0.62F}},
                                                                           {"rose", {1.0F, 0.12F, 0.32F}},
                                                                           {"violet", {0.42F, 0.12F, 1.0F}},
                                                                           {"blue", {0.05F, 0.16F, 1.0F}}}};
    Scene& scene_;
    std::map<std::tuple<std::uint32_t, int, bool>, std::uint32_t> known_;
};

/// Every other lamp has the colour of its side of the bay, the others any.
std::uint32_t colourAt(const vec3& place, std::uint32_t i) {
    const auto bay = static_cast<std::uint32_t>(std::max(0.0F, -place.z / kBay));
    return Glows::colour(drawn(i, 3) < 0.5F ? hashed(2 * bay + (place.x < 0.0F ? 0 : 1), 0, kSeed)
                                            : drawn(i, 4));
}

/// Triangles around the origin that look every way.
Mesh shardsMesh(std::string name, std::uint32_t material, float radius, std::uint32_t count,
                std::uint32_t seed) {
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.material = material;
    mesh.uv_sets.resize(1);
    const auto direction = [seed](std::uint32_t k, std::uint32_t what) {
        const float y = 2.0F * hashed(k, what, seed) - 1.0F;
        const float turned = 2.0F * kPi * hashed(k, what + 1, seed);
        const float across = std::sqrt(1.0F - y * y);
        return vec3(across * std::cos(turned), y, across * std::sin(turned));
    };
    for (std::uint32_t k = 0; k < count; ++k) {
        const vec3 normal = direction(k, 0);
        const vec3 side = glm::normalize(glm::cross(normal, direction(k, 2)));
        const vec3 centre = radius * glm::mix(0.3F, 0.6F, hashed(k, 4, seed)) * direction(k, 5);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const float angle = 2.0F * kPi / 3.0F * static_cast<float>(corner);
            const vec3 out = std::cos(angle) * side + std::sin(angle) * glm::cross(normal, side);
            mesh.positions.push_back(centre + 0.4F * radius * out);
            mesh.normals.push_back(normal);
            mesh.uv_sets[0].emplace_back(0.5F + 0.5F * std::cos(angle), 0.5F - 0.5F * std::sin(angle));
        }
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

/// The dark parts that hold lamps: one box, placed in many sizes.
class Holders {
public:
    explicit Holders(Scene& scene) : scene_(scene) {
        Material metal;
        metal.name = "holders";
        metal.base_color = vec4(0.06F, 0.055F, 0.05F, 1.0F);
        metal.metallic = 0.0F;
        metal.specular = 0.0F;
        box_ = addMesh(scene, boxMesh("holder", addMaterial(scene, metal), vec3(-0.5F), vec3(0.5F)));
    }
    /// `depth` deep along the normal, from the surface at `place`.
    void addBox(const vec3& place, const vec3& normal, const vec3& along, const vec2& half, float depth) {
        const vec3 across = glm::cross(normal, along);
        licht::place(scene_, box_,
                     mat4(vec4(2.0F * half.x * along, 0), vec4(2.0F * half.y * across, 0),
                          vec4(depth * normal, 0), vec4(place + 0.5F * depth * normal, 1)));
    }

private:
    Scene& scene_;
    std::uint32_t box_;
};

constexpr float kFrame = 0.012F;  // how far a flat lamp's frame is wider than the lamp
constexpr float kDepth = 0.03F;
constexpr float kGap = 0.003F;  // between the frame and the light
constexpr float kBar = 0.006F;  // half width of cables and brackets

void addLamp(Scene& scene, Holders& holders, const Lamp& lamp, std::uint32_t i, const Mount& mount,
             const vec2& half, std::uint32_t material) {
    const std::string name = "lamp " + std::to_string(i);
    if (lamp.kind == Kind::panel || lamp.kind == Kind::strip) {
        holders.addBox(mount.place, mount.normal, mount.along, half + kFrame, kDepth);
        const vec3 centre = mount.place + (kDepth + kGap) * mount.normal;
        const vec3 right = half.x * mount.along;
        const vec3 up = half.y * glm::cross(mount.normal, mount.along);
        place(scene, quadMesh(name, material, centre - right - up, centre + right - up, centre + right + up,
                              centre - right + up));
        return;
    }
    const mat4 at = glm::translate(mat4(1.0F), mount.place);
    if (lamp.kind == Kind::sphere)
        place(scene, icosphereMesh(name, material, half.x, lamp.triangles > 20 ? 1 : 0), at);
    else
        place(scene, shardsMesh(name, material, half.x, lamp.triangles, i), at);
    if (mount.held_at == mount.place) return;
    const float length = glm::distance(mount.held_at, mount.place);
    const vec3 away = (mount.held_at - mount.place) / length;
    const vec3 beside = std::abs(away.y) > 0.5F ? vec3(1, 0, 0) : vec3(0, 1, 0);
    holders.addBox(mount.place + half.x * away, away, beside, vec2(kBar), length - half.x);
}

}  // namespace

Scene makeLamps(std::uint64_t triangles) {
    Scene scene;
    scene.name = "lamps";
    const std::vector<Lamp> chosen = chooseLamps(triangles);
    const auto wanted_bays =
        static_cast<std::uint32_t>(std::round(static_cast<double>(chosen.size()) / kLampsInBay));
    const std::uint32_t bays = glm::clamp(wanted_bays, kFewestBays, kMostBays);
    addHall(scene, bays);
    Holders holders(scene);
    Glows glows(scene);
    Occupied occupied;
    occupied.add(kEye, kFreeAroundEye);
    // Where the hall grows no more, lamps become smaller, so that all together shine alike.
    const double usual = kLampsInBay * bays;
    const auto scale =
        static_cast<float>(std::min(1.0, std::sqrt(usual / static_cast<double>(chosen.size()))));
    float shrink = 1.0F;
    std::uint32_t attempt = 0;
    for (std::uint32_t i = 0; i < chosen.size(); ++i) {
        const Lamp& lamp = chosen[i];
        vec2 half;
        Mount mount;
        for (bool free = false; !free; ++attempt) {
            half = scale * shrink * sizeOf(lamp, i);
            // The golden ratio spreads them evenly down the hall, however many there are.
            const double turns = 0.5 * (std::sqrt(5.0) - 1.0) * i;
            const auto share = static_cast<float>(turns - std::floor(turns));
            mount = chooseMount(bays, lamp.kind, share, half.x, attempt);
            free = occupied.add(mount.place, half.x + kDepth + kFrame);
            if (!free) shrink *= 0.999F;
        }
        // Large lamps are duller for their size; the rest is chance, over four and a half stops.
        const float duller = 0.2F * scale / half.y;
        const auto step =
            static_cast<int>(std::lround(2.0F * (std::log2(std::min(duller, 1.0F)) + 4.5F * drawn(i, 2))));
        const bool double_sided = lamp.kind == Kind::shards;
        addLamp(scene, holders, lamp, i, mount, half,
                glows.material(colourAt(mount.place, i), step, double_sided));
    }
    scene.default_exposure = 1.25;
    scene.cameras.push_back(lookingCamera("camera", kEye, {-0.3F, 2.15F, -14.0F}, 0.88F));
    // Down to the floor of the nave: no lamp is in view, whose edges would be noise that no choice of lights
    // changes.
    scene.cameras.push_back(lookingCamera("floor", {0.0F, 2.4F, -9.0F}, {0.0F, 0.0F, -11.0F}, 0.8F));
    return scene;
}

}  // namespace licht
