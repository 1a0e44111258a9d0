#include "licht/on_device/gpu_materials.h"

#include <array>
#include <bit>

#include "licht/scene/slot_table.h"
#include "licht/shared/constants.h"

namespace licht {
namespace {

static_assert(sizeof(MaterialRecord) == kMaterialTexels * sizeof(uvec4));
static_assert(sizeof(TextureSlotRecord) == kSlotWords * sizeof(uvec4));

uint wrapBits(Wrap wrap) {
    return static_cast<uint>(wrap);
}

TextureSlotRecord slotRecord(const TextureSlot& slot, bool srgb) {
    TextureSlotRecord record{};
    record.u_from_uv = slot.u_from_uv;
    record.v_from_uv = slot.v_from_uv;
    record.texture = slot.texture;
    record.flags = (slot.linear ? kSlotLinear : 0U) | wrapBits(slot.wrap_u) << kSlotWrapUShift |
                   wrapBits(slot.wrap_v) << kSlotWrapVShift | (srgb ? kSlotSrgb : 0U) |
                   slot.uv_set << kSlotUvSetShift;
    return record;
}

// KHR_materials_ior: reflectance of a dielectric against air at normal incidence; ior 0 stands for an
// infinite one.
float dielectricF0(float ior) {
    if (ior == 0.0F) return 1.0F;
    const float r = (ior - 1.0F) / (ior + 1.0F);
    return r * r;
}

template <typename Record>
void append(std::vector<uvec4>& details, const Record& record) {
    for (const uvec4& words : std::bit_cast<std::array<uvec4, sizeof(Record) / sizeof(uvec4)>>(record))
        details.push_back(words);
}

template <typename Block>
void appendBlock(MaterialTables& tables, MaterialRecord& material, uint kind, const Block& block) {
    static_assert(sizeof(Block) == sizeof(uvec4));
    const auto words = std::bit_cast<std::array<float, 4>>(block);
    if (words[0] == 0.0F) return;
    material.blocks |= 1U << kind;
    append(tables.details, block);
}

MaterialRecord coreRecord(const Material& m) {
    MaterialRecord r{};
    r.base_color = m.base_color;
    r.emission = m.emission;
    r.metallic = m.metallic;
    r.roughness = m.roughness;
    r.specular = m.specular;
    r.specular_color = m.specular_color;
    r.dielectric_f0 = dielectricF0(m.ior);
    r.normal_scale = m.normal_scale;
    r.alpha_cutoff = m.alpha_cutoff;
    r.flags = (m.unlit ? kMaterialUnlit : 0U) | (m.alpha_mode == AlphaMode::mask ? kMaterialAlphaMask : 0U) |
              (m.alpha_mode == AlphaMode::blend ? kMaterialAlphaBlend : 0U) |
              (m.double_sided ? kMaterialDoubleSided : 0U);
    return r;
}

}  // namespace

MaterialTables materialTables(const std::vector<Material>& materials) {
    MaterialTables tables;
    for (const Material& m : materials) {
        MaterialRecord record = coreRecord(m);
        record.first_detail = static_cast<uint>(tables.details.size());
        for (const SlotInfo& info : kSlotTable) {
            const TextureSlot& slot = m.slots[info.kind];
            if (!slot.present()) continue;
            record.slots |= 1U << info.kind;
            append(tables.details, slotRecord(slot, info.srgb));
        }
#define LICHT_APPEND_BLOCK(number, name, member) appendBlock(tables, record, kBlock##name, m.member);
        LICHT_MATERIAL_BLOCKS(LICHT_APPEND_BLOCK)
#undef LICHT_APPEND_BLOCK
        tables.slots |= record.slots;
        tables.materials.push_back(record);
    }
    return tables;
}

GpuMaterials::GpuMaterials(Uploads& uploads, const std::vector<Material>& materials) {
    const MaterialTables tables = materialTables(materials);
    materials_ = uploads.buffer("materials", tables.materials, kFetchedUsage);
    details_ = uploads.bufferIfAny("material_details", tables.details, kFetchedUsage);
    slots_ = tables.slots;
}

void GpuMaterials::addTo(std::vector<FetchedRecords>& records) const {
    records.push_back({"Materials", "material_texels", &materials_});
    records.push_back({"MaterialDetails", "material_detail_texels", &details_});
}

void GpuMaterials::addTo(gpu::SpecConstants& constants) const {
    constants[kConstantTextureSlotKinds] = slots_;
}

}  // namespace licht
