#include "licht/light/alias_table.h"

#include <numeric>

namespace licht {

std::vector<AliasRecord> buildAliasTable(std::span<const double> weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(sum > 0.0)) return {};
    const auto count = static_cast<double>(weights.size());
    std::vector<AliasRecord> table(weights.size());
    std::vector<double> share(weights.size());
    std::vector<uint> small;
    std::vector<uint> large;
    for (uint i = 0; i < weights.size(); ++i) {
        share[i] = weights[i] / sum * count;
        table[i].pmf = static_cast<float>(weights[i] / sum);
        (share[i] < 1.0 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const uint poor = small.back();
        const uint rich = large.back();
        small.pop_back();
        table[poor].threshold = static_cast<float>(share[poor]);
        table[poor].alias = rich;
        share[rich] -= 1.0 - share[poor];
        if (share[rich] < 1.0) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // What rounding leaves over fills its own column.
    for (const std::vector<uint>* rest : {&small, &large}) {
        for (const uint i : *rest) {
            table[i].threshold = weights[i] > 0.0 ? 1.0F : 0.0F;
            table[i].alias = i;
        }
    }
    return table;
}

}  // namespace licht
