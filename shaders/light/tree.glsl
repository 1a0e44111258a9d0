// One light of many, by a walk down a tree: at each node a child is taken the more often the more it is likely to send.
// Conty Estevez and Kulla 2018, Importance Sampling of Many Lights with Adaptive Tree Splitting. Bounds are conservative: what can light a point has a
// probability greater than zero there.
#ifndef LICHT_LIGHT_TREE_GLSL
#define LICHT_LIGHT_TREE_GLSL

#include "bound/scene_data.glsl"
#include "light/shading_point.glsl"
#include "pure/bsdf.glsl"
#include "pure/spherical.glsl"
#include "shared/bindings.h"
#include "shared/index.h"
#include "shared/light.h"

layout(binding = kBindingLightTreeTexels) uniform usamplerBuffer light_tree_texels;
layout(std430, binding = kBindingLightTree) readonly buffer LightTree { LightChildRecord light_tree[]; };

LightChildRecord lightChildAt(uint i) {
    if (kSceneInStorage) return light_tree[i];
    int first = int(kLightChildTexels * i);
    vec4 a = uintBitsToFloat(texelFetch(light_tree_texels, first)), b = uintBitsToFloat(texelFetch(light_tree_texels, first + 1));
    vec4 c = uintBitsToFloat(texelFetch(light_tree_texels, first + 2));
    uvec4 d = texelFetch(light_tree_texels, first + 3);
    return LightChildRecord(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, uintBitsToFloat(d.x), d.y, uintBitsToFloat(d.z), uintBitsToFloat(d.w));
}

// Mean of max(x, 0) for x even over [c - s, c + s].
float meanAboveZero(float c, float s) {
    float above = max(c + s, 0.0);
    return c >= s ? c : above * above / (4.0 * max(s, kLeastSquare));
}

// Of an angle up to pi / 2; the cosine of a sine as well.
float sineOf(float cosine) { return sqrt(max(1.0 - cosine * cosine, 0.0)); }

// What the lights below a child send to a surface and it sends on, about, up to a factor that siblings share: their mean over positions in the bounding
// sphere and over normals. Not the most that it could be, by which Conty Estevez and Kulla pick: bounds of near and wide clusters are furthest from what
// comes, and in a hall of 200 lamps picks by them had twice the variance. It is 0 only where nothing can come; elsewhere a share of the best is
// kept for the light that is better placed than the mean of its cluster.
float lightImportance(LightChildRecord c, ShadingPoint at) {
    vec3 d = c.centre - at.position;
    float d2 = dot(d, d);
    float inverse = inversesqrt(max(d2, kLeastSquare));
    float facing = dot(d, at.normal);
    // How far the box rises above the surface's horizon.
    if (facing + dot(c.half_size, abs(at.normal)) + kLightSlack * (d2 * inverse) <= 0.0) return 0.0;
    float sin_sphere = min(c.radius * inverse, 1.0), cos_sphere = sineOf(sin_sphere);
    float received = max(meanAboveZero(facing * inverse, sin_sphere), kLightLeastReceived * sin_sphere + kLightSlack);
    if (kGlossy && at.specular > 0.0) {
        // pi D of the half vector, its lobe as much wider as the sphere is.
        float a2 = min(at.alpha * at.alpha + kLightWidening * sin_sphere * sin_sphere, 1.0);
        float cos_sum = max(dot(at.wo, at.normal) + facing * inverse, 0.0), sum2 = 2.0 + 2.0 * dot(at.wo, d) * inverse;
        float x = sum2 / max(a2 * cos_sum * cos_sum + max(sum2 - cos_sum * cos_sum, 0.0), kLeastSquare);
        received += at.specular * a2 * x * x;
    }

    // The angle to the axis within which light can come: that of the normals, of the emission and of the sphere. `spread` is less its cosine.
    float cos_axis = -dot(c.axis, d) * inverse;
    if ((c.next & kLightTwoSided) != 0u) cos_axis = abs(cos_axis);
    bool behind = c.sin_reach * cos_sphere + c.cos_reach * sin_sphere > 0.0;  // less than pi, so that there is a behind
    float spread = behind ? c.sin_reach * sin_sphere - c.cos_reach * cos_sphere : 1.0;
    if (cos_axis + kLightSlack <= -spread) return 0.0;
    float emitted = max(meanAboveZero(c.mean_normal * cos_axis, spread), kLightLeastEmitted);

    float square = d2 + c.softening;
    return square > 0.0 ? c.intensity * received * emitted / square : 0.0;
}

struct TreePick {
    uint light;  // kNoIndex: nothing in the tree reaches this surface
    float pmf;
};

// A node as seen from a surface.
struct LightNode {
    vec4 importance;  // of the children
    uvec4 next;
};

LightNode lightNodeAt(uint node, ShadingPoint at) {
    uint first = kLightChildren * node;
    LightChildRecord a = lightChildAt(first), b = lightChildAt(first + 1u), c = lightChildAt(first + 2u), d = lightChildAt(first + 3u);
    return LightNode(vec4(lightImportance(a, at), lightImportance(b, at), lightImportance(c, at), lightImportance(d, at)),
                     uvec4(a.next, b.next, c.next, d.next));
}

TreePick pickInTree(ShadingPoint at, vec2 u) {
    TreePick pick = TreePick(kNoIndex, 1.0);
    uint node = 0u, level = 0u;
    float x = u.x;
    while (true) {
        LightNode n = lightNodeAt(node, at);
        float sum = n.importance.x + n.importance.y + n.importance.z + n.importance.w;
        if (!(sum > 0.0)) break;
        // The number that has chosen is stretched for the next level; when its bits run low the other one takes over.
        if (++level == 7u) x = u.y;
        vec4 p = n.importance / sum;
        vec3 below = vec3(p.x, p.x + p.y, p.x + p.y + p.z);
        // The first child that reaches x; past the last one, by rounding, the last that can be taken.
        uint k = x < below.x ? 0u : x < below.y ? 1u : x < below.z ? 2u : 3u;
        if (k == 3u && p.w <= 0.0) k = p.z > 0.0 ? 2u : p.y > 0.0 ? 1u : 0u;
        float taken = k == 0u ? p.x : k == 1u ? p.y : k == 2u ? p.z : p.w;
        float before = k == 0u ? 0.0 : k == 1u ? below.x : k == 2u ? below.y : below.z;
        uint next = k == 0u ? n.next.x : k == 1u ? n.next.y : k == 2u ? n.next.z : n.next.w;
        x = clamp((x - before) / taken, 0.0, 0.99999994);
        pick.pmf *= taken;
        node = next & kLightIndexMask;
        if ((next & kLightLeaf) != 0u) {
            pick.light = node;
            break;
        }
    }
    return pick;
}

// With what probability the walk from this surface ends at the light of that trail.
float pmfInTree(ShadingPoint at, uint trail) {
    float pmf = 1.0;
    uint node = 0u;
    while (true) {
        LightNode n = lightNodeAt(node, at);
        float sum = n.importance.x + n.importance.y + n.importance.z + n.importance.w;
        vec4 p = n.importance / sum;
        uint k = trail & (kLightChildren - 1u);
        pmf *= !(sum > 0.0) ? 0.0 : k == 0u ? p.x : k == 1u ? p.y : k == 2u ? p.z : p.w;
        uint next = k == 0u ? n.next.x : k == 1u ? n.next.y : k == 2u ? n.next.z : n.next.w;
        node = next & kLightIndexMask;
        trail >>= kLightTrailBits;
        if ((next & kLightLeaf) != 0u || !(pmf > 0.0)) break;
    }
    return pmf;
}

#endif
