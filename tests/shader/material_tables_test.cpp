// How materials lie in the device's memory.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "licht/on_device/gpu_materials.h"
#include "licht/scene/slot_table.h"

namespace licht {
namespace {

TEST(MaterialTables, APlainMaterialHasNoDetails) {
    const MaterialTables tables = materialTables({Material{}, Material{}});
    EXPECT_EQ(sizeof(MaterialRecord), 80U);
    EXPECT_EQ(tables.materials.size(), 2U);
    EXPECT_TRUE(tables.details.empty());
    EXPECT_EQ(tables.slots, 0U);
}

/// What shaders/bound/scene_data.glsl computes.
uint bitsBelow(uint mask, uint bit) {
    return static_cast<uint>(std::popcount(mask & ((1U << bit) - 1U)));
}

TEST(MaterialTables, SlotsAndBlocksStandWhereTheShadersLook) {
    // Every pair of slots, with and without a block, behind a material that has details of its own.
    for (uint first = 0; first < kSlotCount; ++first) {
        for (uint second = 0; second < kSlotCount; ++second) {
            for (const float factor : {0.0F, 0.5F}) {
                Material before;
                before.slots[first].texture = 3;
                Material m;
                m.slots[first].texture = 11;
                m.slots[second].texture = 12;
                m.iridescence.factor = factor;
                const MaterialTables tables = materialTables({before, m});
                const MaterialRecord& record = tables.materials[1];
                EXPECT_EQ(record.first_detail, kSlotWords);
                EXPECT_EQ(record.slots, 1U << first | 1U << second);
                for (const uint kind : {first, second}) {
                    TextureSlotRecord slot;
                    const uint at = record.first_detail + kSlotWords * bitsBelow(record.slots, kind);
                    std::memcpy(&slot, &tables.details.at(at), sizeof(slot));
                    EXPECT_EQ(slot.texture, m.slots[kind].texture);
                    EXPECT_EQ((slot.flags & kSlotSrgb) != 0, kSlotTable[kind].srgb);
                }
                EXPECT_EQ(record.blocks, factor > 0.0F ? 1U << kBlockIridescence : 0U);
                if (factor > 0.0F) {
                    const uint at = record.first_detail +
                                    kSlotWords * static_cast<uint>(std::popcount(record.slots)) +
                                    bitsBelow(record.blocks, kBlockIridescence);
                    EXPECT_EQ(std::bit_cast<vec4>(tables.details.at(at)), vec4(factor, 1.3F, 100.0F, 400.0F));
                }
            }
        }
    }
}

}  // namespace
}  // namespace licht
