// Meister, Bittner 2018, Parallel Reinsertion for Bounding Volume Hierarchy Optimization. Four rounds get
// what eight do but a hundredth; half of the gain is in the first.
#include "licht/bvh/reinsert.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <vector>

namespace licht {
namespace {

constexpr int kRounds = 4;
constexpr double kLeastGain = 0.002;  // share of all area that a round must save to be followed by another
constexpr std::uint32_t kTaskDepth = 12;  // levels that make tasks
constexpr std::size_t kWaiting = 128;     // places that a search keeps in mind; it forgets what is beyond

struct Move {
    float gain = 0.0F;  ///< area that it saves
    std::uint32_t node = 0;
    std::uint32_t target = 0;  ///< becomes the sibling
};

/// What recomputing a subtree's boxes finds.
struct Summary {
    double area = 0.0;
    std::uint32_t depth = 0;
};

class Reinserter {
public:
    explicit Reinserter(std::span<BinaryNode> nodes) : nodes_(nodes), parents_(nodes.size()) {
        parents_[0] = 0;
        tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t i) {
            if (!nodes[i].isLeaf()) {
                parents_[nodes[i].left] = static_cast<std::uint32_t>(i);
                parents_[nodes[i].right] = static_cast<std::uint32_t>(i);
            }
        });
    }

    void run() {
        const std::uint32_t depth_limit = binaryDepthLimit(static_cast<std::uint32_t>(nodes_.size() / 2 + 1));
        double area = update(0, 0).area;
        std::vector<BinaryNode> before;
        for (int round = 0; round < kRounds; ++round) {
            before.assign(nodes_.begin(), nodes_.end());
            apply(findMoves());
            const Summary now = update(0, 0);
            if (now.depth > depth_limit) {
                std::copy(before.begin(), before.end(), nodes_.begin());
                return;
            }
            if (area - now.area < kLeastGain * area) {
                return;
            }
            area = now.area;
        }
    }

private:
    [[nodiscard]] std::uint32_t sibling(std::uint32_t node) const {
        const BinaryNode& parent = nodes_[parents_[node]];
        return parent.left == node ? parent.right : parent.left;
    }

    /// The moves that gain, the best first.
    [[nodiscard]] std::vector<Move> findMoves() const {
        std::vector<Move> moves(nodes_.size());
        tbb::parallel_for(std::size_t{0}, nodes_.size(),
                          [&](std::size_t i) { moves[i] = findMove(static_cast<std::uint32_t>(i)); });
        const auto better = [](const Move& a, const Move& b) {
            return a.gain > b.gain || (a.gain == b.gain && a.node < b.node);
        };
        std::erase_if(moves, [](const Move& move) { return !(move.gain > 0.0F); });
        tbb::parallel_sort(moves.begin(), moves.end(), better);
        return moves;
    }

    /// Looks at the subtrees beside the path from the node to the root, one after the other, and leaves out
    /// what cannot beat the best place so far.
    [[nodiscard]] Move findMove(std::uint32_t node) const {
        Move best{0.0F, node, 0};
        const std::uint32_t parent = parents_[node];
        if (node == 0 || parent == 0) {
            return best;
        }
        struct Place {
            float saved;  ///< area, before the place itself grows
            std::uint32_t node;
        };
        std::array<Place, kWaiting> waiting;
        const Box box = nodes_[node].box();
        const float area = box.halfArea();
        float saved = nodes_[parent].halfArea();
        std::uint32_t beside = sibling(node);
        std::uint32_t pivot = parent;
        Box shrunk = nodes_[beside].box();  // of the pivot, without the node
        while (true) {
            std::size_t count = 0;
            waiting[count++] = {saved, beside};
            while (count > 0) {
                const Place place = waiting[--count];
                if (place.saved - area <= best.gain) {
                    continue;
                }
                const BinaryNode& target = nodes_[place.node];
                Box merged = target.box();
                const float target_area = merged.halfArea();
                merged.extend(box);
                const float gain = place.saved - merged.halfArea();
                if (gain > best.gain) {
                    best = {gain, node, place.node};
                }
                const float below = gain + target_area;
                if (!target.isLeaf() && below - area > best.gain && count + 2 <= kWaiting) {
                    waiting[count++] = {below, target.left};
                    waiting[count++] = {below, target.right};
                }
            }
            if (pivot != parent) {
                shrunk.extend(nodes_[beside].box());
                saved += nodes_[pivot].halfArea() - shrunk.halfArea();
            }
            if (pivot == 0) {
                return best;
            }
            beside = sibling(pivot);
            pivot = parents_[pivot];
        }
    }

    /// One after the other, and only those that no better one has touched.
    void apply(const std::vector<Move>& moves) {
        std::vector<bool> touched(nodes_.size(), false);
        for (const Move& move : moves) {
            const std::uint32_t parent = parents_[move.node];
            const std::uint32_t beside = sibling(move.node);
            const std::array<std::uint32_t, 5> involved{move.node, move.target, parent, beside,
                                                        parents_[move.target]};
            if (std::any_of(involved.begin(), involved.end(), [&](std::uint32_t i) { return touched[i]; }) ||
                parent == 0 || move.target == beside || isBelow(move.target, move.node)) {
                continue;
            }
            for (const std::uint32_t i : involved) {
                touched[i] = true;
            }
            replaceChild(parents_[parent], parent, beside);
            replaceChild(parents_[move.target], move.target, parent);
            nodes_[parent].left = move.node;
            nodes_[parent].right = move.target;
            parents_[move.target] = parent;
        }
    }

    void replaceChild(std::uint32_t parent, std::uint32_t child, std::uint32_t by) {
        BinaryNode& node = nodes_[parent];
        (node.left == child ? node.left : node.right) = by;
        parents_[by] = parent;
    }

    [[nodiscard]] bool isBelow(std::uint32_t node, std::uint32_t above) const {
        while (node != 0 && node != above) {
            node = parents_[node];
        }
        return node == above;
    }

    Summary update(std::uint32_t index, std::uint32_t depth) {
        BinaryNode& node = nodes_[index];
        if (node.isLeaf()) {
            return {static_cast<double>(node.halfArea()), 1};
        }
        Summary left;
        Summary right;
        const auto updateLeft = [&] { left = update(node.left, depth + 1); };
        const auto updateRight = [&] { right = update(node.right, depth + 1); };
        if (depth < kTaskDepth) {
            tbb::parallel_invoke(updateLeft, updateRight);
        } else {
            updateLeft();
            updateRight();
        }
        Box box = nodes_[node.left].box();
        box.extend(nodes_[node.right].box());
        node.setBox(box);
        return {left.area + right.area + static_cast<double>(box.halfArea()),
                std::max(left.depth, right.depth) + 1};
    }

    std::span<BinaryNode> nodes_;
    std::vector<std::uint32_t> parents_;
};

}  // namespace

void reinsert(std::span<BinaryNode> nodes) {
    if (nodes.size() > 3) {
        Reinserter(nodes).run();
    }
}

}  // namespace licht
