#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "bvh_meshes.h"
#include "licht/bvh/encode_node.h"
#include "licht/bvh/instances.h"
#include "licht/shared/bvh_numerics.h"

namespace licht {
namespace {

using test::Random;
using Meshes = std::vector<std::vector<BvhTriangle>>;

constexpr double kUnit = 0x1p-24;  // u, half an ulp of one

mat4 turned(Random& random, const vec3& scale, const vec3& at) {
    const quat q = glm::angleAxis(random.uniform(0.0F, 6.0F), random.direction());
    mat4 m = glm::mat4_cast(q);
    for (int axis = 0; axis < 3; ++axis) {
        m[axis] *= scale[axis];
    }
    m[3] = vec4(at, 1.0F);
    return m;
}

/// Instances of two spheres and a soup around baked triangles; scales to 3:1, some mirrored.
struct Crowd {
    explicit Crowd(std::uint32_t seed, std::size_t count, float spread = 10.0F, const vec3& at = vec3(0.0F))
        : meshes{test::sphere(vec3(0.0F), 1.0F, 8, 12).triangles, test::soup(60, 0.4F, seed + 1),
                 test::sphere(vec3(0.0F), 0.5F, 5, 6).triangles} {
        Random random(seed);
        for (BvhTriangle t : test::soup(200, 1.0F, seed + 2)) {
            const vec3 shift = at + random.inCube(spread);
            baked.push_back({t.v0 + shift, t.v1 + shift, t.v2 + shift});
        }
        for (std::size_t i = 0; i < count; ++i) {
            vec3 scale(random.uniform(0.5F, 1.5F), random.uniform(0.5F, 1.5F), random.uniform(0.5F, 1.5F));
            scale.x = i % 3 == 0 ? -scale.x : scale.x;
            const mat4 m = turned(random, scale, at + random.inCube(spread));
            instances.push_back(*makeBvhInstance(random.index(meshes.size()), m, vec3(0.0F)));
        }
    }
    [[nodiscard]] TwoLevelBvh build() const { return buildTwoLevelBvh(baked, meshes, instances); }

    Meshes meshes;
    std::vector<BvhTriangle> baked;
    std::vector<BvhInstance> instances;
};

Ray rayInto(Random& random, const vec3& at, float spread) {
    const vec3 origin = at + random.inCube(3.0F * spread);
    return {origin, (at + random.inCube(spread) - origin) * random.uniform(0.01F, 2.0F), 0.0F, kInfinity};
}

void expectSameHit(const std::optional<TwoLevelHit>& a, const std::optional<TwoLevelHit>& b) {
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
        EXPECT_EQ(a->instance, b->instance);
        EXPECT_EQ(a->hit.triangle, b->hit.triangle);
        EXPECT_EQ(a->hit.t, b->hit.t);
        EXPECT_EQ(a->hit.b1, b->hit.b1);
        EXPECT_EQ(a->hit.b2, b->hit.b2);
    }
}

class Places : public testing::TestWithParam<vec3> {};

// The top level loses nothing that an object's own test would accept: near, and far from the world's origin.
TEST_P(Places, TwoLevelsFindBitForBitWhatTestingEverythingFinds) {
    const vec3 at = GetParam();
    const Crowd crowd(11, 150, 10.0F, at);
    const TwoLevelBvh tree = crowd.build();
    Random random(5);
    std::array<int, 2> hits{};
    for (int i = 0; i < 3000; ++i) {
        Ray ray = rayInto(random, at, 10.0F);
        if (i % 4 == 0) {
            ray.t_min = random.uniform(0.0F, 1.0F);
            ray.t_max = ray.t_min + random.uniform(0.0F, 2.0F);
        }
        if (i % 5 == 0) {
            ray.direction[i % 3] = 0.0F;
        }
        const auto found = intersect(tree, crowd.baked, crowd.meshes, ray);
        expectSameHit(found, intersectBruteForce(crowd.instances, crowd.baked, crowd.meshes, ray));
        if (found) {
            ++hits.at(found->instance == kBakedInstance ? 0 : 1);
        }
    }
    EXPECT_GT(hits[0], 100);
    EXPECT_GT(hits[1], 300);
}
INSTANTIATE_TEST_SUITE_P(FarOut, Places,
                         testing::Values(vec3(0.0F), vec3(1000.0F, 0.0F, -3000.0F), vec3(3e6F, 2e6F, -1e6F)));

// The corners of an instance touch its box: rays that pass them by a rounding are lost where the slack is
// missing. Turned first and stretched after it, and seen from afar, so that the object's space moves the ray
// as far as can be.
TEST(TwoLevelBvh, GrazedInstancesAreNotLost) {
    const std::vector<BvhTriangle> plate{{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}},
                                         {{-1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}};
    const Meshes meshes{plate};
    Random random(77);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        mat4 m = glm::scale(mat4(1.0F), vec3(4.0F, 0.4F, 0.4F)) * turned(random, vec3(1.0F), vec3(0.0F));
        m[3] = vec4(random.direction() * vec3(1, 100, 100) * random.uniform(10.0F, 1000.0F), 1.0F);
        const std::optional<BvhInstance> made = makeBvhInstance(0, m, vec3(0.0F));
        if (!made) {
            continue;
        }
        const std::vector<BvhInstance> instances{*made};
        const TwoLevelBvh tree = buildTwoLevelBvh({}, meshes, instances);
        const vec3 corner = worldFromObject(instances[0], {i % 2 == 0 ? 1 : -1, 0, i % 4 < 2 ? 1 : -1});
        const vec3 origin = random.inCube(1.0F);
        const Ray ray{origin, corner - origin, 0.0F, kInfinity};
        const auto found = intersect(tree, {}, meshes, ray);
        expectSameHit(found, intersectBruteForce(instances, {}, meshes, ray));
        hits += found ? 1 : 0;
    }
    EXPECT_GT(hits, 2000);
}

// How far the object's ray strays, seen from the world: kInstanceSlack gives it 9 u of condition times reach.
TEST(BvhInstance, RaysStrayByNoMoreThanTheirShareOfTheSlack) {
    Random random(9);
    double worst = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const vec3 scale(random.uniform(0.2F, 2), random.uniform(0.2F, 2), random.uniform(0.2F, 2));
        const mat4 m =
            i % 2 == 0 ? turned(random, scale, random.inCube(1000.0F))
                       : glm::scale(mat4(1.0F), scale) * turned(random, vec3(1.0F), random.inCube(1000.0F));
        const std::optional<BvhInstance> instance = makeBvhInstance(0, m, vec3(0.0F));
        if (!instance) {
            continue;
        }
        const vec3 target = instance->pivot + random.inCube(1.0F);
        const vec3 origin = instance->pivot + random.inCube(1.0F) * random.uniform(1.0F, 1000.0F);
        const Ray ray{origin, target - origin, 0.0F, kInfinity};
        const Ray object = objectRay(*instance, ray);
        const double t = static_cast<double>(random.uniform(0.0F, 1.0F));
        const glm::dvec3 exact = glm::dvec3(ray.origin) + t * glm::dvec3(ray.direction);
        const glm::dvec3 strayed = glm::dmat3(instance->world_from_object) *
                                       (glm::dvec3(object.origin) + t * glm::dvec3(object.direction)) +
                                   glm::dvec3(instance->pivot);
        const glm::dvec3 way = glm::abs(glm::dvec3(instance->pivot) - glm::dvec3(origin)) + 1.0;
        const glm::dvec3 off = glm::abs(strayed - exact);
        worst = std::max(worst, std::max({off.x, off.y, off.z}) / (static_cast<double>(instance->condition) *
                                                                   std::max({way.x, way.y, way.z})));
    }
    EXPECT_LE(worst, 9.0 * kUnit);
    EXPECT_GT(worst, 0.1 * kUnit) << "nothing was rounded: the test sees nothing";
    EXPECT_GE(static_cast<double>(kInstanceSlack), 27.0 * kUnit);
    RecordProperty("worst_in_u", std::to_string(worst / kUnit));
}

// From inside of a closed instance nothing escapes.
TEST(TwoLevelBvh, InstancesAreWatertight) {
    const Meshes meshes{test::sphere(vec3(0.0F), 1.0F, 16, 24).triangles};
    Random random(3);
    for (int i = 0; i < 50; ++i) {
        const vec3 at = random.inCube(i % 2 == 0 ? 10.0F : 1e5F);
        const mat4 m = turned(
            random, vec3(random.uniform(0.1F, 3), random.uniform(0.1F, 3), random.uniform(0.1F, 3)), at);
        const std::optional<BvhInstance> instance = makeBvhInstance(0, m, vec3(0.0F));
        ASSERT_TRUE(instance);
        const TwoLevelBvh tree = buildTwoLevelBvh({}, meshes, {*instance});
        for (int k = 0; k < 2000; ++k) {
            // Half of them towards a vertex.
            const std::vector<BvhTriangle>& triangles = meshes[0];
            const vec3 target = worldFromObject(*instance, triangles[random.index(triangles.size())].v0);
            const Ray ray{instance->pivot, k % 2 == 0 ? random.direction() : target - instance->pivot, 0.0F,
                          kInfinity};
            ASSERT_TRUE(intersect(tree, {}, meshes, ray)) << "instance " << i << ", ray " << k;
        }
    }
}

// Against the same triangles flattened to world space: the hit lies on the flattened triangle's plane within
// the slack of the instance (its derivation stands with kInstanceSlack) plus the rounding of the flattened
// vertices (4 u of their magnitudes, 16 u of the reach for the flat test's own shear).
TEST(TwoLevelBvh, HitsLieOnTheFlattenedTriangles) {
    for (const vec3& at : {vec3(0.0F), vec3(4000.0F, 100.0F, -2000.0F)}) {
        const Crowd crowd(21, 100, 10.0F, at);
        const TwoLevelBvh tree = crowd.build();
        Random random(6);
        int hits = 0;
        double worst = 0.0;
        for (int i = 0; i < 5000; ++i) {
            const Ray ray = rayInto(random, at, 10.0F);
            const auto found = intersect(tree, crowd.baked, crowd.meshes, ray);
            if (!found || found->instance == kBakedInstance) {
                continue;
            }
            ++hits;
            const BvhInstance& instance = crowd.instances[found->instance];
            const BvhTriangle& object = crowd.meshes[instance.mesh][found->hit.triangle];
            const glm::dvec3 v0(worldFromObject(instance, object.v0));
            const glm::dvec3 v1(worldFromObject(instance, object.v1));
            const glm::dvec3 v2(worldFromObject(instance, object.v2));
            const glm::dvec3 point =
                glm::dvec3(ray.origin) + static_cast<double>(found->hit.t) * glm::dvec3(ray.direction);
            const glm::dvec3 normal = glm::normalize(glm::cross(v1 - v0, v2 - v0));
            const glm::dvec3 far_corner = glm::abs(point - glm::dvec3(ray.origin)) + 4.0;
            const double reach = std::max({far_corner.x, far_corner.y, far_corner.z});
            const glm::dvec3 magnitude = glm::abs(v0) + 4.0;
            const double rounding =
                4.0 * kUnit * (magnitude.x + magnitude.y + magnitude.z) + 16.0 * kUnit * reach;
            const double bound =
                std::sqrt(3.0) * static_cast<double>(kInstanceSlack * instance.condition) * reach + rounding;
            const double off = std::abs(glm::dot(normal, point - v0));
            worst = std::max(worst, off / bound);
            EXPECT_LE(off, bound);
        }
        EXPECT_GT(hits, 500);
        RecordProperty("worst_share_of_bound", std::to_string(worst));
    }
}

TEST(TwoLevelBvh, EqualDistancesGoToBakedThenToTheLowerInstance) {
    const std::vector<BvhTriangle> triangle{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}};
    const Meshes meshes{triangle};
    const BvhInstance here = *makeBvhInstance(0, mat4(1.0F), vec3(0.0F));
    const Ray ray{{0, 0, 2}, {0, 0, -1}, 0.0F, kInfinity};
    const TwoLevelBvh two = buildTwoLevelBvh({}, meshes, {here, here, here});
    EXPECT_EQ(intersect(two, {}, meshes, ray)->instance, 0U);
    const TwoLevelBvh all = buildTwoLevelBvh(triangle, meshes, {here, here});
    EXPECT_EQ(intersect(all, triangle, meshes, ray)->instance, kBakedInstance);
}

TEST(TwoLevelBvh, NothingIsThereWithoutInstancesOrTriangles) {
    const Ray ray{{0, 0, 2}, {0, 0, -1}, 0.0F, kInfinity};
    EXPECT_FALSE(intersect(buildTwoLevelBvh({}, {}, {}), {}, {}, ray));
    const Meshes meshes{{}, {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}};
    const TwoLevelBvh tree = buildTwoLevelBvh(
        {}, meshes,
        {*makeBvhInstance(0, mat4(1.0F), vec3(0.0F)), *makeBvhInstance(1, mat4(1.0F), vec3(0.0F))});
    EXPECT_TRUE(tree.top.empty());
    EXPECT_FALSE(intersect(tree, {}, meshes, ray));
}

TEST(BvhInstance, TransformsThatCannotBeUndoneAreNone) {
    const auto made = [](const mat4& m) { return makeBvhInstance(0, m, vec3(0.0F)).has_value(); };
    const auto scaled = [](float x, float y, float z) { return glm::scale(mat4(1.0F), vec3(x, y, z)); };
    EXPECT_TRUE(made(mat4(1.0F)));
    EXPECT_TRUE(made(scaled(1e-5F, 1e-5F, 1e-5F)));
    EXPECT_TRUE(made(scaled(-1, 1, 1)));
    EXPECT_FALSE(made(scaled(1, 0, 1)));
    EXPECT_FALSE(made(scaled(0, 0, 0)));
    EXPECT_FALSE(made(scaled(1, 1, 1000)));
    EXPECT_FALSE(made(scaled(1e-7F, 1e-7F, 1e-7F)));
    EXPECT_FALSE(made(glm::translate(mat4(1.0F), vec3(1e16F, 0, 0))));
    EXPECT_FALSE(made(scaled(std::nanf(""), 1, 1)));
    EXPECT_TRUE(makeBvhInstance(0, scaled(-1, 1, 1), vec3(0.0F))->mirrored);
}

// The pivot is the image of the centre, so vertices moved by -centre stand where the whole transform puts
// them.
TEST(BvhInstance, PivotIsTheImageOfTheCentre) {
    Random random(8);
    const vec3 centre(1000, -20, 3);
    const mat4 m = turned(random, vec3(2, 1, 0.5F), vec3(7, 8, 9));
    const BvhInstance instance = *makeBvhInstance(0, m, centre);
    for (int i = 0; i < 100; ++i) {
        const vec3 offset = random.inCube(2.0F);
        const glm::dvec3 exact = glm::dmat4(m) * glm::dvec4(glm::dvec3(centre) + glm::dvec3(offset), 1.0);
        const vec3 placed = worldFromObject(instance, offset);
        // Magnitudes: the pivot's coordinates below 2100, the rest below 10; 4 u of the sum.
        EXPECT_LE(glm::length(exact - glm::dvec3(placed)), std::sqrt(3.0) * 4.0 * kUnit * 2110.0);
    }
}

// What the shaders walk: every triangle and every instance is reached from node 0 exactly once, each in its
// box.
TEST(JoinedBvh, HoldsEveryTreeOnce) {
    const Crowd crowd(31, 40);
    const TwoLevelBvh tree = crowd.build();
    std::vector<std::uint32_t> counts{static_cast<std::uint32_t>(crowd.baked.size())};
    for (const auto& mesh : crowd.meshes) {
        counts.push_back(static_cast<std::uint32_t>(mesh.size()));
    }
    const JoinedBvh joined = joinLevels(tree, counts);
    ASSERT_EQ(joined.roots.size(), crowd.meshes.size());

    std::multiset<std::uint32_t> triangles;
    std::multiset<std::uint32_t> instances;
    std::uint32_t deepest = 0;
    const std::function<void(std::uint32_t, std::uint32_t)> walk = [&](std::uint32_t node,
                                                                       std::uint32_t waiting) {
        ASSERT_LT(node, joined.nodes.size());
        std::array<NodeChild, kBvhWidth> children;
        const std::size_t count = decodeNode(joined.nodes[node], children);
        // The siblings of a node wait as one group.
        const std::uint32_t siblings = count > 1 && !children[1].leaf ? 1 : 0;
        deepest = std::max(deepest, waiting + siblings);
        for (std::size_t i = 0; i < count; ++i) {
            const NodeChild& child = children[i];
            if (!child.leaf) {
                walk(child.index, waiting + siblings);
                continue;
            }
            ASSERT_LT(child.index, joined.ids.size());
            const std::uint32_t id = joined.ids[child.index];
            if (child.index < joined.first_instance_position) {
                triangles.insert(id);
                continue;
            }
            instances.insert(id);
            walk(joined.roots[tree.instances[id].mesh], waiting + siblings + kBvhInstanceFrame);
        }
    };
    walk(0, 0);
    std::vector<std::uint32_t> uses(crowd.meshes.size());
    for (const BvhInstance& instance : crowd.instances) {
        ++uses[instance.mesh];
    }
    EXPECT_EQ(instances.size(), crowd.instances.size());
    EXPECT_EQ(std::set(instances.begin(), instances.end()).size(), crowd.instances.size());
    for (std::uint32_t i = 0; i < counts[0]; ++i) {
        EXPECT_EQ(triangles.count(i), 1U);
    }
    for (std::size_t m = 0; m < crowd.meshes.size(); ++m) {
        EXPECT_EQ(triangles.count(joined.first_triangle[m]), uses[m]);
    }
    EXPECT_LE(deepest, joined.max_stack);
}

}  // namespace
}  // namespace licht
