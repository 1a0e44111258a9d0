#pragma once
// The one table that decides what is simulated: each effect has the evidence in the scene that calls for it,
// and everything else (specialisation constants, buffers, passes) follows from the set. Nothing is compiled,
// allocated or computed for an effect that is not called for.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "licht/scene/scene.h"
#include "licht/shared/effects.h"

namespace licht {

/// What an effect is, and what it costs when it is called for.
struct EffectInfo {
    uint id;                ///< kEffect... of licht/shared/effects.h, also the specialisation constant's id
    std::string_view name;  ///< "textures"
    std::string_view meaning;  ///< one line
    std::string_view buffers;  ///< names of the GPU buffers that exist only for it
    std::string_view passes;   ///< passes whose programs carry its code
};

const std::array<EffectInfo, kEffectCount>& effectTable();

/// Which effects a scene calls for, and the first object that called ("material 'Glass' has a base colour
/// texture").
struct Effects {
    std::array<bool, kEffectCount> on{};
    std::array<std::string, kEffectCount> evidence{};

    [[nodiscard]] bool has(uint effect) const { return on[effect]; }
    [[nodiscard]] std::vector<std::string> names() const;
};

Effects detectEffects(const Scene& scene);

/// Every effect, called for or not: the reference that specialised programs are compared with.
Effects allEffects();

}  // namespace licht
