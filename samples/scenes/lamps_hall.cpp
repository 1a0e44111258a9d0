// The hall, cut from cells: what lies between an inner and an outer cell is wall, so the room is closed
// whatever its form.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "samples/scenes/assembly.h"
#include "samples/scenes/lamps.h"
#include "samples/scenes/shapes.h"

namespace licht::lamps {
namespace {

constexpr float kRibHalf = 0.2F;  // ribs under the ceilings run from pillar to pillar
constexpr float kAisleRib = 3.75F;
constexpr float kNaveRib = 6.1F;

/// Planes between the cells of one axis, ascending.
using Planes = std::vector<float>;

Planes planesAlongHall(std::uint32_t bays) {
    Planes planes;
    for (std::uint32_t bay = bays; bay > 0; --bay) {
        const float start = -kBay * static_cast<float>(bay);
        for (const float z : {0.0F, kRibHalf, kNicheStart, kNicheEnd, kBay - kRibHalf})
            planes.push_back(start + z);
    }
    planes.push_back(0.0F);
    return planes;
}

/// Whether the middle of a cell is in the room, which ends where the cells do.
bool inside(const vec3& p, const Planes& along_hall) {
    if (p.y < 0.0F || p.z > 0.0F || p.z < along_hall.front()) return false;
    const float x = std::abs(p.x);
    const float turns = -p.z / kBay;
    const float in_bay = (turns - std::floor(turns)) * kBay;
    const bool under_rib = in_bay < kRibHalf || in_bay > kBay - kRibHalf;
    if (x < kNave) return p.y < (under_rib ? kNaveRib : kNaveHeight);
    if (x < kAisle) return p.y < kArch;
    if (x < kWall) return p.y < (under_rib ? kAisleRib : kAisleHeight);
    return x < kNicheBack && p.y > kNicheSill && p.y < kNicheLintel && in_bay > kNicheStart &&
           in_bay < kNicheEnd;
}

/// The middle of a cell; beyond the first and last plane a cell is one metre wide.
float middle(const Planes& planes, std::size_t cell) {
    if (cell == 0) return planes.front() - 0.5F;
    if (cell == planes.size()) return planes.back() + 0.5F;
    return 0.5F * (planes[cell - 1] + planes[cell]);
}

struct Paints {
    std::uint32_t plaster, ceiling, floor, border;
};

std::uint32_t paintOf(const Paints& paints, const vec3& normal, const vec3& face) {
    if (normal.y < 0.0F) return paints.ceiling;
    if (normal.y == 0.0F || face.y > 0.0F) return paints.plaster;
    const float x = std::abs(face.x);
    return x > kNave && x < kAisle ? paints.border : paints.floor;
}

Material polished(std::string name, const vec3& colour, float roughness) {
    Material material = matte(std::move(name), colour);
    material.specular = 1.0F;
    material.roughness = roughness;
    return material;
}

/// The walls at right angles to an axis: all faces between an inner and an outer cell.
void cutAcross(std::vector<Mesh>& parts, const Paints& paints, std::uint32_t bays, int axis) {
    const std::array<Planes, 3> planes{
        Planes{-kNicheBack, -kWall, -kAisle, -kNave, kNave, kAisle, kWall, kNicheBack},
        Planes{0.0F, kNicheSill, kNicheLintel, kArch, kAisleRib, kAisleHeight, kNaveRib, kNaveHeight},
        planesAlongHall(bays)};
    const int right = (axis + 1) % 3;
    const int top = (axis + 2) % 3;
    const Planes& levels = planes[static_cast<std::size_t>(axis)];
    const Planes& columns = planes[static_cast<std::size_t>(right)];
    const Planes& rows = planes[static_cast<std::size_t>(top)];
    const auto point = [&](float level, float column, float row) {
        vec3 p{0.0F};
        p[axis] = level;
        p[right] = column;
        p[top] = row;
        return p;
    };
    const auto cut = [&](std::size_t k, std::size_t i, std::size_t j) {
        const float column = middle(columns, i);
        const float row = middle(rows, j);
        const bool above = inside(point(middle(levels, k + 1), column, row), planes[2]);
        if (above == inside(point(middle(levels, k), column, row), planes[2])) return;
        // Counter-clockwise seen from the room.
        const float left = columns[above ? i - 1 : i];
        const float far = columns[above ? i : i - 1];
        const std::uint32_t paint =
            paintOf(paints, point(above ? 1.0F : -1.0F, 0.0F, 0.0F), point(levels[k], column, row));
        const auto part = std::find_if(parts.begin(), parts.end(),
                                       [paint](const Mesh& mesh) { return mesh.material == paint; });
        appendMesh(*part, quadMesh({}, paint, point(levels[k], left, rows[j - 1]),
                                   point(levels[k], far, rows[j - 1]), point(levels[k], far, rows[j]),
                                   point(levels[k], left, rows[j])));
    };
    for (std::size_t k = 0; k < levels.size(); ++k)
        for (std::size_t i = 1; i < columns.size(); ++i)
            for (std::size_t j = 1; j < rows.size(); ++j) cut(k, i, j);
}

void addPillars(Scene& scene, std::uint32_t material, std::uint32_t bays) {
    const float r = kPillarRadius;
    const std::uint32_t pillar = addMesh(scene, latheMesh("pillar", material,
                                                          {{1.6F * r, 0.0F},
                                                           {1.6F * r, 0.22F},
                                                           {1.6F * r, 0.22F},
                                                           {1.25F * r, 0.3F},
                                                           {r, 0.36F},
                                                           {r, 0.36F},
                                                           {0.92F * r, 3.12F},
                                                           {0.92F * r, 3.12F},
                                                           {1.1F * r, 3.2F},
                                                           {1.5F * r, 3.42F},
                                                           {1.5F * r, 3.42F},
                                                           {1.5F * r, kArch},
                                                           {1.5F * r, kArch},
                                                           {0.0F, kArch}},
                                                          40));
    for (std::uint32_t k = 1; k < bays; ++k)
        for (const float side : {-1.0F, 1.0F})
            place(scene, pillar, moved({side * kPillarX, 0.0F, -kBay * static_cast<float>(k)}));
}

}  // namespace

void addHall(Scene& scene, std::uint32_t bays) {
    const Paints paints{addMaterial(scene, matte("plaster", {0.68F, 0.66F, 0.63F})),
                        addMaterial(scene, matte("ceiling", {0.60F, 0.58F, 0.56F})),
                        addMaterial(scene, polished("floor", {0.30F, 0.28F, 0.26F}, 0.28F)),
                        addMaterial(scene, polished("floor border", {0.09F, 0.09F, 0.10F}, 0.22F))};
    std::vector<Mesh> parts;
    for (const auto& [name, material] :
         {std::pair{"walls", paints.plaster}, std::pair{"ceiling", paints.ceiling},
          std::pair{"floor", paints.floor}, std::pair{"floor border", paints.border}}) {
        Mesh mesh;
        mesh.name = name;
        mesh.material = material;
        parts.push_back(std::move(mesh));
    }
    for (int axis = 0; axis < 3; ++axis) cutAcross(parts, paints, bays, axis);
    for (Mesh& part : parts) place(scene, std::move(part));
    addPillars(scene, paints.plaster, bays);
}

}  // namespace licht::lamps
