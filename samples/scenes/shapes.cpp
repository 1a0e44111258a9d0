#include "samples/scenes/shapes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace licht {
namespace {

float fraction(std::uint32_t part, std::uint32_t whole) {
    return static_cast<float>(part) / static_cast<float>(whole);
}

/// The angle of a seam's last vertex is the first one's, bit for bit, so that closed shapes are closed.
float turn(std::uint32_t part, std::uint32_t whole) {
    return 2.0F * kPi * fraction(part % whole, whole);
}

/// Counter-clockwise seen from above.
vec3 around(float angle) {
    return {std::cos(angle), 0.0F, -std::sin(angle)};
}

void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto& p = mesh.positions;
    if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh.triangles.emplace_back(a, b, c);
}

}  // namespace

Mesh gridMesh(std::string name, std::uint32_t material, std::uint32_t columns, std::uint32_t rows,
              const std::function<ShapeVertex(std::uint32_t, std::uint32_t)>& vertex) {
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.material = material;
    mesh.uv_sets.resize(1);
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const ShapeVertex v = vertex(column, row);
            mesh.positions.push_back(v.position);
            mesh.normals.push_back(glm::normalize(v.normal));
            mesh.uv_sets[0].push_back(v.uv);
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = row * (columns + 1) + column;
            const std::uint32_t d = a + columns + 1;
            addTriangle(mesh, a, a + 1, d + 1);
            addTriangle(mesh, a, d + 1, d);
        }
    }
    return mesh;
}

Mesh quadMesh(std::string name, std::uint32_t material, const vec3& bottom_left, const vec3& bottom_right,
              const vec3& top_right, const vec3& top_left) {
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.material = material;
    const auto faceNormal = [](const vec3& a, const vec3& b, const vec3& c) {
        return glm::normalize(glm::cross(b - a, c - a));
    };
    const vec3 lower = faceNormal(bottom_left, bottom_right, top_right);
    const vec3 upper = faceNormal(bottom_left, top_right, top_left);
    mesh.positions = {bottom_left, bottom_right, top_right, bottom_left, top_right, top_left};
    mesh.normals = {lower, lower, lower, upper, upper, upper};
    mesh.uv_sets = {{{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0}}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    return mesh;
}

Mesh boxMesh(std::string name, std::uint32_t material, const vec3& lower, const vec3& upper) {
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.material = material;
    mesh.uv_sets.resize(1);
    for (int axis = 0; axis < 3; ++axis) {
        const int right = (axis + 1) % 3;
        const int top = (axis + 2) % 3;
        for (const bool positive : {false, true}) {
            const Mesh face = gridMesh({}, material, 1, 1, [&](std::uint32_t column, std::uint32_t row) {
                const bool far_right = (column == 1) == positive;
                ShapeVertex v{};
                v.position[axis] = positive ? upper[axis] : lower[axis];
                v.position[right] = far_right ? upper[right] : lower[right];
                v.position[top] = row == 1 ? upper[top] : lower[top];
                v.normal[axis] = positive ? 1.0F : -1.0F;
                v.uv = {v.position[right], -v.position[top]};
                return v;
            });
            appendMesh(mesh, face);
        }
    }
    return mesh;
}

Mesh roundedBoxMesh(std::string name, std::uint32_t material, const vec3& size, float radius,
                    std::uint32_t steps) {
    assert(2.0F * radius <= std::min({size.x, size.y, size.z}));
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.material = material;
    mesh.uv_sets.resize(1);
    const vec3 core = 0.5F * size - radius;
    // A face's net runs over half of each rounded edge, the flat part, and half of the opposite edge. The
    // edge shared by two faces has the slope one in both nets, so that they meet in the same points.
    const auto slope = [steps](std::uint32_t k) {
        const std::uint32_t step = k <= steps ? steps - k : k - steps - 1;
        const float magnitude = step == steps ? 1.0F : std::tan(0.25F * kPi * fraction(step, steps));
        return k <= steps ? -magnitude : magnitude;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int right = (axis + 1) % 3;
        const int top = (axis + 2) % 3;
        for (const float sign : {-1.0F, 1.0F}) {
            const std::uint32_t last = 2 * steps + 1;
            const Mesh face =
                gridMesh({}, material, last, last, [&](std::uint32_t column, std::uint32_t row) {
                    const std::uint32_t k = sign > 0.0F ? column : last - column;
                    vec3 normal{};
                    normal[axis] = sign;
                    normal[right] = slope(k);
                    normal[top] = slope(row);
                    // Summed in the order of the axes, so that both faces of an edge round alike.
                    normal *=
                        1.0F / std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
                    vec3 corner{};
                    corner[axis] = sign * core[axis];
                    corner[right] = k <= steps ? -core[right] : core[right];
                    corner[top] = row <= steps ? -core[top] : core[top];
                    const vec3 position = corner + radius * normal;
                    return ShapeVertex{position, normal, {position[right], -position[top]}};
                });
            appendMesh(mesh, face);
        }
    }
    return mesh;
}

Mesh sphereMesh(std::string name, std::uint32_t material, float radius, std::uint32_t segments,
                std::uint32_t rings) {
    return gridMesh(std::move(name), material, segments, rings, [&](std::uint32_t column, std::uint32_t row) {
        const float latitude = kPi * (fraction(row, rings) - 0.5F);
        const bool pole = row == 0 || row == rings;
        const float y = row == 0 ? -1.0F : row == rings ? 1.0F : std::sin(latitude);
        const vec3 normal =
            vec3(0, y, 0) + (pole ? 0.0F : std::cos(latitude)) * around(turn(column, segments));
        return ShapeVertex{
            radius * normal, normal, {fraction(column, segments), 1.0F - fraction(row, rings)}};
    });
}

Mesh icosphereMesh(std::string name, std::uint32_t material, float radius, std::uint32_t halvings) {
    // Corners: the cyclic permutations of (0, +-1, +-golden ratio).
    constexpr float g = std::numbers::phi_v<float>;
    std::vector<vec3> directions{{0, 1, g},  {0, -1, g},  {0, 1, -g}, {0, -1, -g}, {1, g, 0},  {-1, g, 0},
                                 {1, -g, 0}, {-1, -g, 0}, {g, 0, 1},  {g, 0, -1},  {-g, 0, 1}, {-g, 0, -1}};
    std::vector<uvec3> triangles{{0, 1, 8},  {0, 10, 1}, {0, 4, 5},   {0, 8, 4}, {0, 5, 10},
                                 {1, 7, 6},  {1, 6, 8},  {1, 10, 7},  {2, 9, 3}, {2, 3, 11},
                                 {2, 5, 4},  {2, 4, 9},  {2, 11, 5},  {3, 6, 7}, {3, 9, 6},
                                 {3, 7, 11}, {4, 8, 9},  {5, 11, 10}, {6, 9, 8}, {7, 10, 11}};
    for (vec3& direction : directions) direction = glm::normalize(direction);
    for (std::uint32_t halving = 0; halving < halvings; ++halving) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, fresh] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(directions.size()));
            if (fresh) directions.push_back(glm::normalize(directions[a] + directions[b]));
            return found->second;
        };
        std::vector<uvec3> finer;
        for (const uvec3& t : triangles) {
            const uvec3 m{middle(t.x, t.y), middle(t.y, t.z), middle(t.z, t.x)};
            finer.insert(finer.end(), {{t.x, m.x, m.z}, {t.y, m.y, m.x}, {t.z, m.z, m.y}, m});
        }
        triangles = std::move(finer);
    }
    Mesh mesh;
    mesh.name = std::move(name);
    mesh.material = material;
    mesh.triangles = std::move(triangles);
    mesh.uv_sets.resize(1);
    for (const vec3& direction : directions) {
        mesh.positions.push_back(radius * direction);
        mesh.normals.push_back(direction);
        mesh.uv_sets[0].emplace_back(0.5F - 0.5F * std::atan2(direction.z, direction.x) / kPi,
                                     std::acos(glm::clamp(direction.y, -1.0F, 1.0F)) / kPi);
    }
    return mesh;
}

Mesh torusMesh(std::string name, std::uint32_t material, float ring_radius, float tube_radius,
               std::uint32_t segments, std::uint32_t sides) {
    return gridMesh(std::move(name), material, segments, sides, [&](std::uint32_t column, std::uint32_t row) {
        const vec3 out = around(turn(column, segments));
        const float angle = turn(row, sides);
        const vec3 normal = std::cos(angle) * out + vec3(0, std::sin(angle), 0);
        return ShapeVertex{ring_radius * out + tube_radius * normal,
                           normal,
                           {fraction(column, segments), 1.0F - fraction(row, sides)}};
    });
}

Mesh torusKnotMesh(std::string name, std::uint32_t material, const TorusKnot& knot, std::uint32_t segments,
                   std::uint32_t sides) {
    const auto centre = [&](float angle) {
        const float radius = knot.ring_radius + knot.winding_radius * std::cos(knot.q * angle);
        return radius * around(knot.p * angle) + vec3(0, knot.winding_radius * std::sin(knot.q * angle), 0);
    };
    const float step = 2.0F * kPi / static_cast<float>(segments);
    return gridMesh(std::move(name), material, segments, sides, [&](std::uint32_t column, std::uint32_t row) {
        const float angle = turn(column, segments);
        const vec3 here = centre(angle);
        const vec3 tangent = glm::normalize(centre(angle + step) - centre(angle - step));
        // The direction away from the ring's circle of centres never runs along the curve, which winds around
        // it.
        const vec3 away = here - knot.ring_radius * around(knot.p * angle);
        const vec3 side = glm::normalize(glm::cross(tangent, away));
        const vec3 up = glm::cross(side, tangent);
        const float turned = turn(row, sides);
        const vec3 normal = std::cos(turned) * up + std::sin(turned) * -side;
        return ShapeVertex{here + knot.tube_radius * normal,
                           normal,
                           {fraction(column, segments), 1.0F - fraction(row, sides)}};
    });
}

Mesh latheMesh(std::string name, std::uint32_t material, const std::vector<vec2>& profile,
               std::uint32_t segments) {
    assert(profile.size() >= 2);
    const std::size_t count = profile.size();
    std::vector<vec2> normals(count);
    std::vector<float> lengths(count, 0.0F);
    for (std::size_t k = 0; k < count; ++k) {
        vec2 along{0.0F};
        if (k > 0 && profile[k] != profile[k - 1]) along += glm::normalize(profile[k] - profile[k - 1]);
        if (k + 1 < count && profile[k + 1] != profile[k])
            along += glm::normalize(profile[k + 1] - profile[k]);
        normals[k] = glm::normalize(vec2(along.y, -along.x));
        if (k > 0) lengths[k] = lengths[k - 1] + glm::distance(profile[k], profile[k - 1]);
    }
    const auto rows = static_cast<std::uint32_t>(count - 1);
    return gridMesh(std::move(name), material, segments, rows, [&](std::uint32_t column, std::uint32_t row) {
        const vec3 out = around(turn(column, segments));
        return ShapeVertex{profile[row].x * out + vec3(0, profile[row].y, 0),
                           normals[row].x * out + vec3(0, normals[row].y, 0),
                           {fraction(column, segments), lengths[rows] - lengths[row]}};
    });
}

std::vector<vec2> smoothProfile(const std::vector<vec2>& points, std::uint32_t steps) {
    assert(points.size() >= 2);
    std::vector<vec2> curve;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const vec2 p0 = points[k == 0 ? 0 : k - 1];
        const vec2 p1 = points[k];
        const vec2 p2 = points[k + 1];
        const vec2 p3 = points[std::min(k + 2, points.size() - 1)];
        for (std::uint32_t i = 0; i < steps; ++i) {
            const float t = fraction(i, steps);
            const vec2 p =
                0.5F * (2.0F * p1 + (p2 - p0) * t + (2.0F * p0 - 5.0F * p1 + 4.0F * p2 - p3) * t * t +
                        (3.0F * p1 - p0 - 3.0F * p2 + p3) * t * t * t);
            curve.emplace_back(std::max(p.x, 0.0F), p.y);
        }
    }
    curve.push_back(points.back());
    return curve;
}

Mesh coneMesh(std::string name, std::uint32_t material, float lower_radius, float upper_radius, float height,
              std::uint32_t segments) {
    const vec2 lower{lower_radius, 0};
    const vec2 upper{upper_radius, height};
    std::vector<vec2> profile;
    // The rim of each end is a crease; an end of no radius is a tip and has none.
    if (lower_radius > 0.0F) {
        profile.emplace_back(0.0F, 0.0F);
        profile.push_back(lower);
    }
    profile.push_back(lower);
    profile.push_back(upper);
    if (upper_radius > 0.0F) {
        profile.push_back(upper);
        profile.emplace_back(0.0F, height);
    }
    return latheMesh(std::move(name), material, profile, segments);
}

Mesh curtainMesh(std::string name, std::uint32_t material, const vec2& size, std::uint32_t folds,
                 float depth) {
    const std::uint32_t columns = 16 * folds;
    return gridMesh(std::move(name), material, columns, 1, [&](std::uint32_t column, std::uint32_t row) {
        const float u = fraction(column, columns);
        const float phase = 2.0F * kPi * static_cast<float>(folds) * u;
        const float slope = depth * std::cos(phase) * 2.0F * kPi * static_cast<float>(folds) / size.x;
        const float v = static_cast<float>(row);
        return ShapeVertex{{size.x * u, size.y * v, depth * std::sin(phase)},
                           {-slope, 0, 1},
                           {u * size.x, (1.0F - v) * size.y}};
    });
}

void appendMesh(Mesh& whole, const Mesh& part, const mat4& whole_from_part) {
    assert(whole.material == part.material);
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    const mat3 normal_matrix = glm::transpose(glm::inverse(mat3(whole_from_part)));
    whole.uv_sets.resize(1);
    for (std::size_t k = 0; k < part.positions.size(); ++k) {
        whole.positions.emplace_back(whole_from_part * vec4(part.positions[k], 1.0F));
        whole.normals.push_back(glm::normalize(normal_matrix * part.normals[k]));
        whole.uv_sets[0].push_back(part.uv_sets[0][k]);
    }
    for (const uvec3& triangle : part.triangles) whole.triangles.push_back(triangle + first);
}

}  // namespace licht
