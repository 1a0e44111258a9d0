#pragma once
// Two levels: meshes that many instances share have a hierarchy each, in object space, and one above them
// holds the boxes of their instances; everything else is baked into one tree in world space.
#include <optional>
#include <span>
#include <vector>

#include "licht/bvh/binary_tree.h"
#include "licht/bvh/bvh.h"

namespace licht {

/// Where a mesh stands: world = world_from_object * object + pivot, and back: object = object_from_world *
/// (world - pivot). Seen from the pivot, so that an instance far from the world's origin loses no bits.
struct BvhInstance {
    std::uint32_t mesh = 0;
    mat3 world_from_object{1.0F};
    mat3 object_from_world{1.0F};
    vec3 pivot{0.0F};  ///< the image of the object's origin, metres
    float condition =
        1.0F;  ///< product of both matrices' largest row sums of magnitudes: how much rounding grows
    bool mirrored = false;
};

/// A transform whose condition is larger is baked: rays would lose too many bits on the way to the object.
inline constexpr float kMostCondition = 64.0F;
/// Scales outside of [1 / this, this] are baked, so that rays in object space stay within what can be traced.
inline constexpr float kMostInstanceScale = 1048576.0F;

/// The instance of a mesh whose vertices were moved by -centre (so that its pivot lies inside of it).
/// nullopt: the transform is singular, too skewed, too large or too small to be undone safely.
std::optional<BvhInstance> makeBvhInstance(std::uint32_t mesh, const mat4& world_from_object,
                                           const vec3& centre);

vec3 worldFromObject(const BvhInstance& instance, const vec3& point);

/// The same ray seen from the object. The direction is not normalised, so t means the same place.
Ray objectRay(const BvhInstance& instance, const Ray& ray);

/// Holds the exact image of each point, the pivot too; the rounding of the images is allowed for.
Bounds instanceBounds(const BvhInstance& instance, std::span<const vec3> points);

struct TwoLevelBvh {
    Bvh baked;                ///< triangles in world space
    std::vector<Bvh> meshes;  ///< in object space
    std::vector<BvhInstance> instances;
    std::vector<BinaryNode> top;         ///< over the instances' boxes, one a leaf; empty: there are none
    std::vector<std::uint32_t> top_ids;  ///< what a leaf of the top level holds -> instance
    std::vector<Bounds> top_boxes;       ///< and that one's box
    Bounds top_bounds;                   ///< of the instances' boxes
    float slack = 0.0F;  ///< of a ray's reach: what going to object space can move a ray by, at most
    double build_seconds = 0.0;
};

/// Instances of meshes without a usable triangle are left out of the top level.
TwoLevelBvh buildTwoLevelBvh(std::span<const BvhTriangle> baked,
                             std::span<const std::vector<BvhTriangle>> meshes,
                             std::vector<BvhInstance> instances, const BvhBuildOptions& options = {});

inline constexpr std::uint32_t kBakedInstance = 0xffffffffU;

struct TwoLevelHit {
    std::uint32_t instance = kBakedInstance;  ///< kBakedInstance: `triangle` is one of the baked ones
    BvhHit hit;
};

/// The nearest hit; ties go to the baked triangles, then to the lower instance, then to the lower triangle.
///
/// A ray hits an instance where objectRay() hits the mesh. That is watertight within each instance, because
/// all of its triangles meet the same ray; and the hit lies within slack * reach of the mesh's exact image,
/// reach being the largest distance (per axis) from the ray's origin to the instance. Bit for bit what
/// intersectBruteForce() returns.
std::optional<TwoLevelHit> intersect(const TwoLevelBvh& tree, std::span<const BvhTriangle> baked,
                                     std::span<const std::vector<BvhTriangle>> meshes, const Ray& ray);

/// The naive reference: every triangle of every instance.
std::optional<TwoLevelHit> intersectBruteForce(std::span<const BvhInstance> instances,
                                               std::span<const BvhTriangle> baked,
                                               std::span<const std::vector<BvhTriangle>> meshes,
                                               const Ray& ray);

/// All trees in one list of nodes, as the shaders walk them from node 0: children's links are moved, leaves
/// of the top level stand at positions behind all triangles.
struct JoinedBvh {
    std::vector<BvhNode> nodes;
    std::vector<std::uint32_t> ids;    ///< per position: a triangle (baked ones first, then mesh by mesh), or
                                       ///< from first_instance_position on an instance
    std::vector<std::uint32_t> roots;  ///< per mesh
    std::vector<std::uint32_t> first_triangle;  ///< per mesh: what its triangle 0 is called in `ids`
    std::uint32_t first_instance_position = 0;
    std::uint32_t max_stack = 1;  ///< of a walk through both levels
};
/// `triangle_counts`: input triangles of baked, then of each mesh. Throws InputError, with the numbers, where
/// nodes or positions of all trees are more than kBvhMostTriangles.
JoinedBvh joinLevels(const TwoLevelBvh& tree, std::span<const std::uint32_t> triangle_counts);

}  // namespace licht
