#pragma once
// The one table that decides what is simulated: each effect has the evidence in the scene that calls for it,
// and what is compiled follows from the set.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "licht/scene/scene.h"
#include "licht/shared/effects.h"

namespace licht {

struct LookedAt;

/// What an effect is, and what calls for it.
struct EffectInfo {
    uint id;                ///< kEffect... of licht/shared/effects.h, also the specialisation constant's id
    std::string_view name;  ///< "textures"
    std::string_view meaning;                  ///< one line
    std::string (*evidence)(const LookedAt&);  ///< the first object that calls for it; empty: none does
};

const std::array<EffectInfo, kEffectCount>& effectTable();

/// Which effects a scene calls for, and the first object that called ("material 'Glass' has a base colour
/// texture").
struct Effects {
    std::array<bool, kEffectCount> on{};
    std::array<std::string, kEffectCount> evidence{};

    [[nodiscard]] bool has(uint effect) const { return on[effect]; }
    [[nodiscard]] std::vector<std::string> names() const;
    /// As specialisation constants, id by id.
    void addTo(std::map<std::uint32_t, std::uint32_t>& constants) const;
};

Effects detectEffects(const Scene& scene);

/// Every effect, called for or not: the reference that specialised programs are compared with.
Effects allEffects();

}  // namespace licht
