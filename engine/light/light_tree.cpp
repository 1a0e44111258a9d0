#include "licht/light/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace licht {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint kMostHalvings = 32;
constexpr std::size_t kBins = 12;

// All directions within `angle` of `axis`.
struct Cone {
    glm::dvec3 axis{0, 0, 1};
    double angle = kPi;
};

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// The smallest cone around two cones.
Cone around(Cone a, Cone b) {
    if (a.angle < b.angle) std::swap(a, b);
    const double apart = angleBetween(a.axis, b.axis);
    if (std::min(apart + b.angle, kPi) <= a.angle) return a;
    const double angle = 0.5 * (a.angle + apart + b.angle);
    if (angle >= kPi) return {a.axis, kPi};
    const glm::dvec3 pivot = glm::cross(a.axis, b.axis);
    if (!(glm::dot(pivot, pivot) > 0.0)) return {a.axis, kPi};
    const glm::dvec3 k = glm::normalize(pivot);
    const double turn = angle - a.angle;
    return {glm::normalize(a.axis * std::cos(turn) + glm::cross(k, a.axis) * std::sin(turn)), angle};
}

// What is known of all lights below a node.
struct Cluster {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    Cone normals;
    double emission_angle = 0.0;
    double intensity = 0.0;
    bool two_sided = false;

    void add(const Cluster& c) {
        if (c.intensity <= 0.0) return;
        low = glm::min(low, c.low);
        high = glm::max(high, c.high);
        normals = intensity > 0.0 ? around(normals, c.normals) : c.normals;
        emission_angle = std::max(emission_angle, c.emission_angle);
        intensity += c.intensity;
        two_sided = two_sided || c.two_sided;
    }

    // Measure of the directions that are lit: the orientation term of the surface area orientation heuristic.
    [[nodiscard]] double orientation() const {
        const double o = normals.angle;
        const double w = std::min(o + emission_angle, kPi);
        const double one_side =
            2.0 * kPi * (1.0 - std::cos(o)) +
            0.5 * kPi * (2.0 * w * std::sin(o) - std::cos(o - 2.0 * w) - 2.0 * o * std::sin(o) + std::cos(o));
        return two_sided ? 2.0 * one_side : one_side;
    }

    [[nodiscard]] double area() const {
        const glm::dvec3 e = high - low;
        return 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x);
    }

    [[nodiscard]] double cost() const { return intensity > 0.0 ? intensity * orientation() * area() : 0.0; }
};

Cluster clusterOf(const LightBound& light) {
    return {light.low,       light.high,     {light.axis, light.normals_angle}, light.emission_angle,
            light.intensity, light.two_sided};
}

class Builder {
public:
    explicit Builder(std::span<const LightBound> lights) : order_(lights.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
        double sum = 0.0;
        for (const LightBound& light : lights) {
            sum += light.intensity;
            clusters_.push_back(clusterOf(light));
            centres_.push_back(0.5 * (light.low + light.high));
        }
        constexpr int kExponentOfSum = 60;
        if (sum > 0.0) intensity_exponent_ = kExponentOfSum - std::ilogb(sum);
        tree_.trails.resize(lights.size());
    }

    LightTree run() {
        split(0, order_.size(), 0, 0, 0);
        return std::move(tree_);
    }

private:
    struct Range {
        std::size_t first;
        std::size_t end;
        uint halvings;  // from all lights to these
        [[nodiscard]] std::size_t size() const { return end - first; }
    };

    // Halves the range until there are enough children, the least halved first: so every level of the tree
    // takes two halvings at least, and 32 of them fit into a trail.
    std::vector<Range> childrenOf(const Range& range) {
        std::vector<Range> ranges{range};
        while (ranges.size() < kLightChildren) {
            const auto next =
                std::max_element(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) {
                    if ((a.size() > 1) != (b.size() > 1)) return b.size() > 1;
                    return a.halvings != b.halvings ? a.halvings > b.halvings : a.size() < b.size();
                });
            if (next->size() == 1) break;
            const Range whole = *next;
            const std::size_t middle = chooseMiddle(whole.first, whole.end, whole.halvings);
            *next = {whole.first, middle, whole.halvings + 1};
            ranges.insert(next + 1, {middle, whole.end, whole.halvings + 1});
        }
        return ranges;
    }

    void split(std::size_t first, std::size_t end, uint halvings, uint trail, uint level) {
        const std::size_t node = tree_.children.size() / kLightChildren;
        tree_.children.resize(tree_.children.size() + kLightChildren);
        const std::vector<Range> ranges = childrenOf({first, end, halvings});
        for (uint k = 0; k < ranges.size(); ++k) {
            const Range& range = ranges[k];
            const uint branch = trail | (k << (kLightTrailBits * level));
            LightChildRecord record = recordOf(clusterOfRange(range.first, range.end));
            if (range.size() == 1) {
                record.next |= kLightLeaf | order_[range.first];
                tree_.trails[order_[range.first]] = branch;
            } else {
                record.next |= static_cast<uint>(tree_.children.size() / kLightChildren);
            }
            tree_.children[kLightChildren * node + k] = record;
            if (range.size() > 1) split(range.first, range.end, range.halvings, branch, level + 1);
        }
    }

    [[nodiscard]] Cluster clusterOfRange(std::size_t first, std::size_t end) const {
        Cluster sum;
        for (std::size_t i = first; i < end; ++i) sum.add(clusters_[order_[i]]);
        return sum;
    }

    // The cheapest of the binned splits; by count, where the trail would get too long otherwise or nothing
    // tells the lights apart.
    std::size_t chooseMiddle(std::size_t first, std::size_t end, uint halvings) {
        const std::size_t count = end - first;
        glm::dvec3 low(std::numeric_limits<double>::infinity());
        glm::dvec3 high(-std::numeric_limits<double>::infinity());
        for (std::size_t i = first; i < end; ++i) {
            low = glm::min(low, centres_[order_[i]]);
            high = glm::max(high, centres_[order_[i]]);
        }
        const glm::dvec3 extent = high - low;
        const int widest = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const auto halvings_left = static_cast<std::size_t>(kMostHalvings - halvings);
        const bool short_of_halvings =
            static_cast<std::size_t>(std::bit_width(count - 1)) + 1 >= halvings_left;
        double best_cost = std::numeric_limits<double>::infinity();
        int best_axis = -1;
        std::size_t best_bin = 0;
        const auto binOf = [&](uint light, int axis) {
            const double x = (centres_[light][axis] - low[axis]) / extent[axis];
            return std::min(static_cast<std::size_t>(x * static_cast<double>(kBins)), kBins - 1);
        };
        for (int axis = 0; axis < 3 && !short_of_halvings && count > 2; ++axis) {
            if (!(extent[axis] > 0.0)) continue;
            std::array<Cluster, kBins> bins;
            for (std::size_t i = first; i < end; ++i) bins[binOf(order_[i], axis)].add(clusters_[order_[i]]);
            std::array<double, kBins> right{};
            Cluster sum;
            for (std::size_t b = kBins - 1; b > 0; --b) {
                sum.add(bins[b]);
                right[b] = sum.intensity > 0.0 ? sum.cost() : -1.0;
            }
            Cluster left;
            // Thin boxes are not cut along their thin side.
            const double shape = extent[widest] / extent[axis];
            for (std::size_t b = 0; b + 1 < kBins; ++b) {
                left.add(bins[b]);
                if (!(left.intensity > 0.0) || right[b + 1] < 0.0) continue;
                const double cost = shape * (left.cost() + right[b + 1]);
                if (cost < best_cost) {
                    best_cost = cost;
                    best_axis = axis;
                    best_bin = b;
                }
            }
        }
        const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
        const auto stop = order_.begin() + static_cast<std::ptrdiff_t>(end);
        if (best_axis >= 0) {
            const auto middle =
                std::partition(begin, stop, [&](uint l) { return binOf(l, best_axis) <= best_bin; });
            return static_cast<std::size_t>(middle - order_.begin());
        }
        const std::size_t half = first + count / 2;
        std::nth_element(
            begin, order_.begin() + static_cast<std::ptrdiff_t>(half), stop, [&](uint a, uint b) {
                return centres_[a][widest] != centres_[b][widest] ? centres_[a][widest] < centres_[b][widest]
                                                                  : a < b;
            });
        return half;
    }

    [[nodiscard]] LightChildRecord recordOf(const Cluster& cluster) const {
        LightChildRecord record{};
        record.centre = vec3(0.5 * (cluster.low + cluster.high));
        // The box must hold everything after rounding.
        const glm::dvec3 half =
            glm::max(cluster.high - glm::dvec3(record.centre), glm::dvec3(record.centre) - cluster.low);
        record.half_size = vec3(half * (1.0 + 0x1p-20));
        record.radius = glm::length(record.half_size) * (1.0F + 0x1p-20F);
        record.softening = kLightSoftening * record.radius * record.radius;
        record.axis = vec3(cluster.normals.axis);
        record.mean_normal = static_cast<float>(0.5 * (1.0 + std::cos(cluster.normals.angle)));
        const double reach = cluster.normals.angle + cluster.emission_angle;
        record.cos_reach = reach < kPi ? static_cast<float>(std::cos(reach)) : -1.0F;
        record.sin_reach = reach < kPi ? static_cast<float>(std::sin(reach)) : 0.0F;
        record.intensity = static_cast<float>(std::ldexp(cluster.intensity, intensity_exponent_));
        record.next = cluster.two_sided ? kLightTwoSided : 0U;
        return record;
    }

    std::vector<uint> order_;
    std::vector<Cluster> clusters_;
    // Only ratios count; this one keeps the whole far from both ends of what floats hold. Exact.
    int intensity_exponent_ = 0;
    std::vector<glm::dvec3> centres_;
    LightTree tree_;
};

// shaders/light/tree.glsl in double precision.
double meanAboveZero(double c, double s) {
    const double above = std::max(c + s, 0.0);
    return c >= s || above <= 0.0 ? std::max(c, 0.0) : above * above / (4.0 * s);
}

double importance(const LightChildRecord& c, const ShadingPoint& at) {
    const glm::dvec3 d = glm::dvec3(c.centre) - at.position;
    const double distance = glm::length(d);
    const glm::dvec3 half(c.half_size);
    const auto slack = static_cast<double>(kLightSlack);
    if (glm::dot(d, at.normal) + glm::dot(half, glm::abs(at.normal)) + slack * distance <= 0.0) return 0.0;
    const glm::dvec3 w = distance > 0.0 ? d / distance : glm::dvec3(0.0);
    const double radius = glm::length(half);
    const double sphere = radius < distance ? std::asin(radius / distance) : 0.5 * kPi;
    const double cos_receiver = glm::dot(w, at.normal);
    double received = std::max(meanAboveZero(cos_receiver, std::sin(sphere)),
                               static_cast<double>(kLightLeastReceived) * std::sin(sphere) + slack);
    if (at.specular > 0.0) {
        const double sine = std::sin(sphere);
        const double a2 =
            std::min(at.alpha * at.alpha + static_cast<double>(kLightWidening) * sine * sine, 1.0);
        const double cos_sum = std::max(glm::dot(at.wo, at.normal) + cos_receiver, 0.0);
        const double sum2 = 2.0 + 2.0 * glm::dot(at.wo, w);
        const double below = a2 * cos_sum * cos_sum + std::max(sum2 - cos_sum * cos_sum, 0.0);
        if (below > 0.0) received += at.specular * a2 * (sum2 / below) * (sum2 / below);
    }
    double cos_axis = -glm::dot(glm::dvec3(c.axis), w);
    if ((c.next & kLightTwoSided) != 0) cos_axis = std::abs(cos_axis);
    const double reach =
        std::atan2(static_cast<double>(c.sin_reach), static_cast<double>(c.cos_reach)) + sphere;
    const double spread = reach < kPi ? -std::cos(reach) : 1.0;
    if (cos_axis + slack <= -spread) return 0.0;
    const double emitted = std::max(meanAboveZero(static_cast<double>(c.mean_normal) * cos_axis, spread),
                                    static_cast<double>(kLightLeastEmitted));
    const double square = distance * distance + static_cast<double>(c.softening);
    return square > 0.0 ? static_cast<double>(c.intensity) * received * emitted / square : 0.0;
}

}  // namespace

LightTree buildLightTree(std::span<const LightBound> lights) {
    assert(lights.size() >= 2 && lights.size() <= kMostLights);
    return Builder(lights).run();
}

double lightTreePmf(const LightTree& tree, const ShadingPoint& point, uint trail) {
    double pmf = 1.0;
    for (uint node = 0;; trail >>= kLightTrailBits) {
        const LightChildRecord* children = &tree.children[std::size_t{kLightChildren} * node];
        double sum = 0.0;
        for (uint k = 0; k < kLightChildren; ++k) sum += importance(children[k], point);
        if (!(sum > 0.0)) return 0.0;
        const LightChildRecord& taken = children[trail & (kLightChildren - 1)];
        pmf *= importance(taken, point) / sum;
        if ((taken.next & kLightLeaf) != 0) return pmf;
        node = taken.next & kLightIndexMask;
    }
}

}  // namespace licht
