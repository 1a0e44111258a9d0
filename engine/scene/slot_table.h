#pragma once
// What the list of texture slots says about each of them.
#include <array>
#include <string_view>

#include "licht/shared/slots.h"

namespace licht {

struct SlotInfo {
    uint kind;                   ///< kSlot...
    std::string_view name;       ///< "base colour"
    bool srgb;                   ///< RGB is decoded by the sRGB curve
    std::string_view extension;  ///< of glTF; empty: the core
    std::string_view key;        ///< in its material
};

#define LICHT_SLOT_ROW(number, name, srgb, words, extension, key) \
    SlotInfo{kSlot##name, words, srgb, extension, key},
inline constexpr std::array<SlotInfo, kSlotCount> kSlotTable{{LICHT_TEXTURE_SLOTS(LICHT_SLOT_ROW)}};
#undef LICHT_SLOT_ROW

/// Whether row i is about kSlot... i.
constexpr bool slotsAreInOrder() {
    for (uint kind = 0; kind < kSlotCount; ++kind)
        if (kSlotTable[kind].kind != kind) return false;
    return true;
}
static_assert(slotsAreInOrder());

}  // namespace licht
