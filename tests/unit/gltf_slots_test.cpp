// Every texture slot of the list, from the file to the list of effects.
#include <gtest/gtest.h>

#include "../support/gltf_file.h"
#include "licht/core/error.h"
#include "licht/image/files.h"
#include "licht/scene/effects.h"
#include "licht/scene/gltf.h"
#include "licht/scene/slot_table.h"
#include "licht/shared/effects.h"

namespace licht {
namespace {

using test::GltfFile;
using test::Json;
using test::TemporaryFolder;

/// A triangle whose material shows all that slots read, and has a texture in that slot alone, read by
/// TEXCOORD_2, which the mesh does not have.
Scene load(const SlotInfo& info, const TemporaryFolder& folder) {
    GltfFile file = GltfFile::triangle();
    writePng(folder.path() / "black.png", Image(1, 1, 3));
    file.add("images", {{"uri", "black.png"}});
    file.add("textures", {{"source", 0}});
    Json material{{"name", "X"},
                  {"emissiveFactor", {1, 1, 1}},
                  {"pbrMetallicRoughness", {{"metallicFactor", 0.5}}},
                  {"extensions",
                   {{"KHR_materials_iridescence", {{"iridescenceFactor", 1}}},
                    {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}};
    const Json texture{{"index", 0}, {"texCoord", 2}};
    const std::string key(info.key);
    const bool in_core = info.kind == kSlotNormal || info.kind == kSlotEmissive;
    if (!info.extension.empty()) {
        material["extensions"][std::string(info.extension)][key] = texture;
    } else if (in_core) {
        material[key] = texture;
    } else {
        material["pbrMetallicRoughness"][key] = texture;
    }
    file.primitive()["material"] = file.add("materials", material);
    return loadGltf(file.writeGlb(folder));
}

TEST(Slots, EachIsLoadedCompletedCheckedAndCalledFor) {
    const TemporaryFolder folder;
    for (const SlotInfo& info : kSlotTable) {
        SCOPED_TRACE(info.name);
        Scene scene = load(info, folder);
        Material& m = scene.materials.at(0);
        for (uint kind = 0; kind < kSlotCount; ++kind)
            EXPECT_EQ(m.slots.at(kind).present(), kind == info.kind) << kSlotTable.at(kind).name;
        EXPECT_EQ(scene.meshes.at(0).uv_sets.size(), 3U);
        const Effects effects = detectEffects(scene);
        EXPECT_NE(effects.evidence[kEffectTextures].find(info.name), std::string::npos);
        EXPECT_NE(effects.evidence[kEffectExtraUvSets].find(info.name), std::string::npos);
        EXPECT_NO_THROW(validateScene(scene));
        m.slots.at(info.kind).texture = 7;
        EXPECT_THROW(validateScene(scene), InputError);
    }
}

}  // namespace
}  // namespace licht
