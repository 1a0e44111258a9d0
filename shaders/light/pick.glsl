// Which light: a column of the alias table, the first of which may stand for the tree.
#ifndef LICHT_LIGHT_PICK_GLSL
#define LICHT_LIGHT_PICK_GLSL

#include "bound/surface.glsl"
#include "light/table.glsl"
#include "light/tree.glsl"
#include "shared/choices.h"
#include "shared/constants.h"
#include "shared/index.h"

layout(constant_id = kConstantLights) const uint kLights = kLightsPower;

// The choice heeds what surfaces reflect where, too.
const bool kHeedsGloss = kGlossy && kLights == kLightsTree;

// wo: world, unit.
PackedShadingPoint shadingPointAt(Surface s, vec3 wo) {
    ShadingPoint p = ShadingPoint(s.position, s.frame.normal, s.frame.normal, 1.0, 0.0);
    if (kHeedsGloss) {
        float cos_o = dot(wo, s.frame.normal);
        p.wo = wo;
        vec2 gloss = cos_o > 0.0 ? glossTowards(s.bsdf, cos_o) : vec2(1.0, 0.0);
        p.alpha = gloss.x;
        p.specular = gloss.y;
    }
    return packShadingPoint(p);
}

struct LightPick {
    uint light;  // kNoIndex: none
    float pmf;   // of the tree alone; 1: it had no part in it
};

LightPick pickLight(PackedShadingPoint at, vec2 u) {
    float x = u.x * float(frame.light_slots);
    uint slot = min(uint(x), frame.light_slots - 1u);
    AliasRecord column = lightAliasAt(slot);
    bool keep = u.y < column.threshold;
    if (!keep) slot = column.alias;
    if (kLights != kLightsTree || frame.tree_lights == 0u) return LightPick(slot, 1.0);
    if (slot > 0u) return LightPick(frame.tree_lights + slot - 1u, 1.0);
    // What the two numbers have not yet decided is uniform again.
    float rest = keep ? u.y / column.threshold : (u.y - column.threshold) / (1.0 - column.threshold);
    TreePick pick = pickInTree(unpackShadingPoint(at), vec2(fract(x), min(rest, 0.99999994)));
    return LightPick(pick.light, pick.pmf);
}

// Probability of picking light `index` from there.
float pmfOfLight(LightRecord light, uint index, PackedShadingPoint at) {
    if (kLights != kLightsTree || index >= frame.tree_lights || light.pmf <= 0.0) return light.pmf;
    return light.pmf * pmfInTree(unpackShadingPoint(at), light.trail);
}

#endif
