// Mountains at every scale from the range down to the mesh's own, with boulders strewn over them, in morning
// sun.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <thread>
#include <vector>

#include "samples/scenes/assembly.h"
#include "samples/scenes/builtin_scenes.h"
#include "samples/scenes/pattern.h"
#include "samples/scenes/shapes.h"
#include "samples/scenes/tessellation.h"

namespace licht {
namespace {

constexpr float kSide = 1200.0F;              // metres, of the square
constexpr float kPeak = 260.0F;               // height of the highest noise
constexpr float kLargestCell = 420.0F;        // metres between lattice points of the first octave
constexpr float kFinestCell = 3.0F;           // spacings of the mesh: a finer detail would be spikes
constexpr std::uint32_t kPeriod = 1U << 16U;  // lattice points; beyond every octave's
const vec2 kEye{30.0F, 540.0F};               // x and z of the camera
const vec3 kSun = glm::normalize(vec3(-0.62F, 0.42F, -0.30F));

/// Uneven ground from 40 m down to the mesh's own scale.
float hummocks(const vec2& p, float spacing) {
    float sum = 0.0F;
    float height = 3.4F;
    float cell = 38.0F;
    for (std::uint32_t octave = 0; cell > kFinestCell * spacing; ++octave) {
        sum += height * valueNoise((p + vec2(kSide)) / cell, uvec2(kPeriod), 40 + octave);
        height *= 0.5F;
        cell *= 0.47F;
    }
    return sum;
}

/// The ground's height over a point. Details finer than `spacing` are left out.
float heightAt(const vec2& p, float spacing) {
    const uvec2 period(kPeriod);
    const vec2 origin(0.5F * kSide);
    // Bent, so that ridges do not follow the lattice.
    const vec2 q = (p + origin) / kLargestCell;
    const vec2 bent = q + 0.35F * vec2(valueNoise(1.7F * q + vec2(3.1F, 7.7F), period, 11),
                                       valueNoise(1.7F * q + vec2(9.2F, 1.3F), period, 12));
    float sum = 0.0F;
    float weight = 0.55F;
    float gain = 1.0F;
    vec2 x = bent;
    for (std::uint32_t octave = 0;
         kLargestCell / std::exp2(static_cast<float>(octave)) > kFinestCell * spacing; ++octave) {
        const float noise = valueNoise(x, period, 20 + octave);
        // Ridges where the noise crosses its middle (Musgrave, in Ebert et al., "Texturing and Modeling",
        // 2002).
        const float ridge = 1.0F - std::abs(2.0F * noise - 1.0F);
        const float sharp = ridge * ridge * gain;
        sum += weight * sharp;
        gain = glm::clamp(1.6F * sharp, 0.0F, 1.0F);
        weight *= 0.47F;
        // Turned by the angle of a 3-4-5 triangle, so that the octaves' lattices do not meet.
        x = 2.0F * vec2(0.8F * x.x - 0.6F * x.y, 0.6F * x.x + 0.8F * x.y) + vec2(kPeriod / 4);
    }
    // A valley, in which the camera stands.
    const float valley = softStep(15.0F, 260.0F, std::abs(p.x - 60.0F * std::sin(0.008F * p.y)));
    return kPeak * sum * (0.30F + 0.70F * valley) + hummocks(p, spacing);
}

vec4 colourAt(const vec3& p, float up) {
    const float patches = valueNoise(vec2(p.x, p.z) / 7.0F + vec2(500.0F), uvec2(kPeriod), 61);
    const vec3 grass = glm::mix(vec3(0.10F, 0.145F, 0.035F), vec3(0.22F, 0.20F, 0.07F), patches);
    const vec3 rock = glm::mix(vec3(0.21F, 0.19F, 0.17F), vec3(0.33F, 0.29F, 0.25F), patches);
    const float snow_line = 0.46F * kPeak + 25.0F * patches;
    vec3 colour = glm::mix(rock, grass, softStep(0.72F, 0.88F, up + 0.1F * (patches - 0.5F)));
    colour = glm::mix(colour, vec3(0.80F, 0.82F, 0.86F),
                      softStep(0.0F, 18.0F, p.y - snow_line) * softStep(0.5F, 0.7F, up));
    return {colour, 1.0F};
}

/// On all cores, because ten million triangles are waited for.
void forEachRow(std::uint32_t rows, const std::function<void(std::uint32_t)>& work) {
    const std::uint32_t threads = std::max(1U, std::thread::hardware_concurrency());
    std::vector<std::jthread> helpers;
    for (std::uint32_t t = 0; t < threads; ++t)
        helpers.emplace_back([=, &work] {
            for (std::uint32_t row = t; row < rows; row += threads) work(row);
        });
}

/// Twice the area of a face times its normal; zero beyond the border. Each quad has two, split from its first
/// corner.
vec3 faceArea(const Mesh& mesh, const GridCut& cut, std::int64_t row, std::int64_t column, bool second) {
    if (row < 0 || column < 0 || row >= cut.rows || column >= cut.columns) return vec3(0.0F);
    const std::size_t across = std::size_t{cut.columns} + 1;
    const std::size_t a = static_cast<std::size_t>(row) * across + static_cast<std::size_t>(column);
    const vec3 diagonal = mesh.positions[a + across + 1] - mesh.positions[a];
    return second ? glm::cross(diagonal, mesh.positions[a + across] - mesh.positions[a])
                  : glm::cross(mesh.positions[a + 1] - mesh.positions[a], diagonal);
}

/// The mean of the faces around a vertex, lifted until it is on the outer side of each of them, as +Y always
/// is.
vec3 groundNormal(const Mesh& mesh, const GridCut& cut, std::int64_t row, std::int64_t column) {
    const std::array faces{
        faceArea(mesh, cut, row, column, false),        faceArea(mesh, cut, row, column, true),
        faceArea(mesh, cut, row, column - 1, false),    faceArea(mesh, cut, row - 1, column - 1, false),
        faceArea(mesh, cut, row - 1, column - 1, true), faceArea(mesh, cut, row - 1, column, true)};
    vec3 normal(0.0F);
    for (const vec3& face : faces) normal += face;
    normal = glm::normalize(normal);
    const auto isBehind = [&](const vec3& face) { return face.y > 0.0F && glm::dot(face, normal) <= 0.0F; };
    while (std::any_of(faces.begin(), faces.end(), isBehind)) normal = glm::normalize(normal + vec3(0, 1, 0));
    return normal;
}

Mesh groundMesh(std::uint32_t material, const GridCut& cut) {
    Mesh mesh;
    mesh.name = "ground";
    mesh.material = material;
    const std::uint32_t across = cut.columns + 1;
    const std::size_t vertices = std::size_t{across} * (cut.rows + 1);
    mesh.positions.resize(vertices);
    mesh.normals.resize(vertices);
    mesh.colors.resize(vertices);
    mesh.triangles.resize(cut.triangles());
    const vec2 step = kSide / vec2(static_cast<float>(cut.columns), static_cast<float>(cut.rows));
    const float spacing = std::max(step.x, step.y);
    forEachRow(cut.rows + 1, [&](std::uint32_t row) {
        for (std::uint32_t column = 0; column < across; ++column) {
            const vec2 at(static_cast<float>(column) * step.x - 0.5F * kSide,
                          0.5F * kSide - static_cast<float>(row) * step.y);
            mesh.positions[std::size_t{row} * across + column] = {at.x, heightAt(at, spacing), at.y};
        }
    });
    forEachRow(cut.rows + 1, [&](std::uint32_t row) {
        for (std::uint32_t column = 0; column < across; ++column) {
            const std::size_t i = std::size_t{row} * across + column;
            mesh.normals[i] = groundNormal(mesh, cut, row, column);
            mesh.colors[i] = colourAt(mesh.positions[i], mesh.normals[i].y);
        }
    });
    forEachRow(cut.rows, [&](std::uint32_t row) {
        for (std::uint32_t column = 0; column < cut.columns; ++column) {
            const std::uint32_t a = row * across + column;
            const std::size_t i = 2 * (std::size_t{row} * cut.columns + column);
            mesh.triangles[i] = {a, a + 1, a + across + 1};
            mesh.triangles[i + 1] = {a, a + across + 1, a + across};
        }
    });
    return mesh;
}

/// How far a boulder reaches in that direction, of a radius of one: planes that cut a sphere make facets.
float boulderReach(const vec3& direction, std::uint32_t seed) {
    float reach = 1.0F;
    for (std::uint32_t plane = 10; plane < 19; ++plane) {
        const float y = 1.0F - 2.0F * hashed(seed, plane, 6);
        const float angle = 2.0F * kPi * hashed(seed, plane, 7);
        const float across = std::sqrt(std::max(0.0F, 1.0F - y * y));
        const float cosine = glm::dot(direction, vec3(across * std::cos(angle), y, across * std::sin(angle)));
        const float distance = 0.62F + 0.25F * hashed(seed, plane, 8);
        if (cosine > 0.0F) reach = std::min(reach, distance / cosine);
    }
    return reach;
}

void addBoulder(Mesh& all, const vec3& centre, float radius, const SphereCut& cut, std::uint32_t seed) {
    const Mesh sphere = sphereMesh("", all.material, 1.0F, cut.segments, cut.rings);
    const vec3 size = radius * vec3(0.8F + 0.5F * hashed(seed, 1, 5), 0.55F + 0.3F * hashed(seed, 2, 5),
                                    0.8F + 0.5F * hashed(seed, 3, 5));
    const mat3 turned(moved(vec3(0.0F), 2.0F * kPi * hashed(seed, 3, 71)));
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    for (const vec3& direction : sphere.positions)
        all.positions.push_back(centre + turned * (boulderReach(direction, seed) * size * direction));
    all.normals.resize(all.positions.size(), vec3(0.0F));
    for (const uvec3& t : sphere.triangles) {
        const uvec3 triangle = t + first;
        all.triangles.push_back(triangle);
        const vec3 a = all.positions[triangle.x];
        const vec3 area = glm::cross(all.positions[triangle.y] - a, all.positions[triangle.z] - a);
        for (int k = 0; k < 3; ++k) all.normals[triangle[k]] += area;
    }
    const vec3 tint = glm::mix(vec3(0.22F, 0.20F, 0.18F), vec3(0.38F, 0.34F, 0.30F), hashed(seed, 4, 5));
    all.colors.resize(all.positions.size(), vec4(tint, 1.0F));
}

/// More of them near the camera, so that distance does not make them vanish.
Mesh boulders(std::uint32_t material, std::uint64_t triangles, float spacing) {
    Mesh all;
    all.name = "boulders";
    all.material = material;
    const std::uint64_t count = std::clamp<std::uint64_t>(triangles / 120, 4, 600);
    const SphereCut cut = cutSphere(triangles / count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const float distance = 9.0F * std::pow(55.0F, hashed(i, 0, 71));
        const float angle = 1.2F * (hashed(i, 1, 71) - 0.5F);
        const vec2 at = kEye + distance * vec2(std::sin(angle), -std::cos(angle));
        const float radius = 0.35F + 0.012F * distance + 2.2F * std::pow(hashed(i, 2, 71), 6.0F);
        addBoulder(all, vec3(at.x, heightAt(at, spacing) + 0.15F * radius, at.y), radius, cut, i);
    }
    for (vec3& n : all.normals)
        n = n == vec3(0.0F) ? vec3(0, 1, 0) : glm::normalize(n);  // no triangle has every pole
    return all;
}

}  // namespace

Scene makeTerrain(std::uint64_t triangles) {
    Scene scene;
    scene.name = "terrain";
    Material soil;
    soil.name = "soil";
    soil.metallic = 0.0F;
    soil.roughness = 1.0F;
    soil.specular = 0.0F;
    const std::uint32_t material = addMaterial(scene, soil);
    const GridCut rough = cutGrid(triangles);
    const float spacing = kSide / static_cast<float>(std::min(rough.columns, rough.rows));
    Mesh rocks = boulders(material, triangles / 8, spacing);
    const GridCut cut = cutGrid(triangles - rocks.triangles.size());
    place(scene, groundMesh(material, cut));
    place(scene, std::move(rocks));

    PunctualLight sun;
    sun.name = "sun";
    sun.kind = PunctualLight::Kind::directional;
    sun.direction = -kSun;
    sun.intensity = vec3(11.5F, 9.6F, 7.0F);
    scene.lights.push_back(sun);
    scene.environment = paintSky("morning", 128, 64, [](const vec3& direction, float) {
        const float height = softStep(-0.05F, 0.6F, direction.y);
        const float glow = std::exp(-4.0F * (1.0F - glm::dot(direction, kSun)));
        return glm::mix(vec3(1.25F, 1.35F, 1.5F), vec3(0.30F, 0.58F, 1.15F), height) +
               glow * vec3(1.1F, 0.8F, 0.45F);
    });
    const vec3 eye(kEye.x, heightAt(kEye, spacing) + 14.0F, kEye.y);
    scene.cameras.push_back(lookingCamera("camera", eye, eye + vec3(-0.08F, -0.02F, -1.0F), 0.85F));
    return scene;
}

}  // namespace licht
