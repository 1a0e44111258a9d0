#include <string>
#include <utility>

#include "samples/scenes/assembly.h"
#include "samples/scenes/gallery.h"
#include "samples/scenes/gallery_textures.h"

namespace licht::gallery {
namespace {

Material glossy(std::string name, const vec3& color, float roughness) {
    Material material = matte(std::move(name), color);
    material.specular = 1.0F;
    material.roughness = roughness;
    return material;
}

Material metal(std::string name, const vec3& color, float roughness) {
    Material material = glossy(std::move(name), color, roughness);
    material.metallic = 1.0F;
    return material;
}

Material lamp(std::string name, const vec3& radiance) {
    Material material = matte(std::move(name), vec3(0.8F));
    material.emission = radiance;
    return material;
}

TextureSlot slot(std::uint32_t texture, float scale = 1.0F) {
    TextureSlot result;
    result.texture = texture;
    result.u_from_uv = {scale, 0, 0};
    result.v_from_uv = {0, scale, 0};
    return result;
}

}  // namespace

Materials addMaterials(Scene& scene) {
    Materials m{};
    const auto add = [&](Material material) { return addMaterial(scene, std::move(material)); };
    const auto printed = [&](Material material, Texture texture) {
        material.slots[kSlotBaseColor] = slot(addTexture(scene, std::move(texture)));
        return add(std::move(material));
    };

    m.plaster = add(matte("plaster", {0.78F, 0.74F, 0.68F}));
    m.accent_wall = add(matte("petrol wall", {0.19F, 0.29F, 0.30F}));
    m.ceiling = add(matte("ceiling", {0.80F, 0.77F, 0.72F}));

    Material parquet = glossy("parquet", vec3(1.0F), 1.0F);
    parquet.slots[kSlotBaseColor] = slot(addTexture(scene, parquetColor()));
    parquet.slots[kSlotNormal] = slot(addTexture(scene, parquetNormal()));
    parquet.slots[kSlotMetallicRoughness] = slot(addTexture(scene, parquetRoughness()));
    m.parquet = add(std::move(parquet));
    m.tiles = printed(glossy("tiles", vec3(1.0F), 0.3F), checkerTiles());

    const std::uint32_t grain = addTexture(scene, woodGrain());
    const auto wood = [&](std::string name, const vec3& tint, float roughness, float scale) {
        Material material = glossy(std::move(name), tint, roughness);
        material.slots[kSlotBaseColor] = slot(grain, scale);
        return add(std::move(material));
    };
    m.dark_wood = wood("stained beams", {0.8F, 0.72F, 0.64F}, 0.6F, 1.0F);
    m.oak = wood("oak", {1.7F, 1.65F, 1.6F}, 0.4F, 1.4F);
    m.walnut = wood("varnished walnut", {0.75F, 0.62F, 0.55F}, 0.18F, 1.6F);
    m.steel = add(glossy("black steel", vec3(0.025F), 0.35F));
    Material linen = matte("linen", {0.80F, 0.75F, 0.66F});
    linen.double_sided = true;
    m.linen = add(std::move(linen));

    m.rug = printed(matte("rug", vec3(1.0F)), rugPattern());
    m.rug_edge = add(matte("rug edge", {0.03F, 0.08F, 0.10F}));
    const std::uint32_t weave = addTexture(scene, fabricNormal());
    const auto fabric = [&](std::string name, const vec3& color) {
        Material material = matte(std::move(name), color);
        material.slots[kSlotNormal] = slot(weave, 10.0F);
        return add(std::move(material));
    };
    m.upholstery = fabric("rust upholstery", {0.46F, 0.15F, 0.065F});
    m.cushion = fabric("cream cushion", {0.68F, 0.60F, 0.47F});
    m.picture = printed(matte("landscape", vec3(1.0F)), landscapePicture());
    m.passepartout = add(matte("passepartout", {0.82F, 0.79F, 0.73F}));

    m.copper = add(metal("copper", {0.955F, 0.60F, 0.46F}, 0.22F));
    m.gold = add(metal("gold", {1.0F, 0.77F, 0.34F}, 0.12F));
    m.brass = add(metal("brushed brass", {0.88F, 0.70F, 0.38F}, 0.35F));
    m.mirror = add(metal("mirror", vec3(0.92F), 0.06F));
    m.plinth = add(matte("plinth", {0.80F, 0.78F, 0.74F}));
    m.white_ceramic = add(glossy("white ceramic", {0.82F, 0.79F, 0.73F}, 0.15F));
    m.blue_ceramic = add(glossy("petrol glaze", {0.03F, 0.13F, 0.17F}, 0.1F));
    m.terracotta = add(glossy("terracotta", {0.50F, 0.21F, 0.11F}, 0.7F));
    m.book_red = add(glossy("red book", {0.45F, 0.09F, 0.06F}, 0.5F));
    m.book_cream = add(glossy("cream book", {0.75F, 0.66F, 0.50F}, 0.6F));
    m.book_blue = add(glossy("blue book", {0.06F, 0.16F, 0.24F}, 0.5F));

    Material leaf = glossy("leaves", vec3(1.0F), 0.45F);
    leaf.alpha_mode = AlphaMode::mask;
    leaf.double_sided = true;
    leaf.slots[kSlotBaseColor] = slot(addTexture(scene, leafCutout()));
    leaf.slots[kSlotBaseColor].wrap_u = Wrap::clamp;
    leaf.slots[kSlotBaseColor].wrap_v = Wrap::clamp;
    m.leaf = add(std::move(leaf));
    m.stem = add(matte("stems", {0.10F, 0.19F, 0.06F}));
    m.earth = add(matte("earth", {0.06F, 0.04F, 0.03F}));

    m.bulb = add(lamp("warm bulb", {120.0F, 74.0F, 34.0F}));
    // Stands for the light that a fabric shade lets through.
    Material shade = lamp("lamp shade", {1.5F, 0.92F, 0.45F});
    shade.double_sided = true;
    m.shade = add(std::move(shade));
    m.globe = add(lamp("opal globe", {9.0F, 6.4F, 3.7F}));
    m.glow = add(lamp("hidden lamp", {40.0F, 25.0F, 14.0F}));
    m.cable = add(matte("cable", vec3(0.03F)));
    return m;
}

}  // namespace licht::gallery
