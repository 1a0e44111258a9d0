#include "samples/scenes/gallery_textures.h"

#include <algorithm>
#include <cmath>

#include "samples/scenes/pattern.h"

namespace licht::gallery {
namespace {

/// Where a point lies in a herringbone of planks one unit wide and kPlankLength units long.
struct Plank {
    std::uint32_t column, row;  ///< the cell the plank begins in: its name
    float along, across;        ///< [0, kPlankLength], [0, 1]
};

constexpr int kPlankLength = 4;
constexpr int kPlanksPerTile = 16;

int wrap(int value, int period) {
    return ((value % period) + period) % period;
}

Plank plankAt(const vec2& uv) {
    const vec2 p = uv * static_cast<float>(kPlanksPerTile);
    const vec2 cell = glm::floor(p);
    const vec2 inside = p - cell;
    const int x = static_cast<int>(cell.x);
    const int y = static_cast<int>(cell.y);
    // Each diagonal step swaps one cell of a lying plank for one of a standing plank.
    const int step = wrap(x - y, 2 * kPlankLength);
    const auto name = [](int k) { return static_cast<std::uint32_t>(wrap(k, kPlanksPerTile)); };
    if (step < kPlankLength) return {name(x - step), name(y), static_cast<float>(step) + inside.x, inside.y};
    const int before = 2 * kPlankLength - 1 - step;
    return {name(x), name(y - before) + 64U, static_cast<float>(before) + inside.y, inside.x};
}

/// Distance to the plank's border in plank widths.
float borderDistance(const Plank& plank) {
    return std::min(
        {plank.across, 1.0F - plank.across, plank.along, static_cast<float>(kPlankLength) - plank.along});
}

/// Fibres that run along the plank, different in each one.
float fibres(const Plank& plank) {
    const auto seed = static_cast<std::uint32_t>(hashed(plank.column, plank.row, 3) * 4096.0F);
    const vec2 point{plank.along / static_cast<float>(kPlankLength), plank.across};
    const float bend = 0.12F * fractalNoise(point, {3, 2}, 2, seed + 100);
    return fractalNoise({point.x, glm::fract(point.y + bend)}, {4, 14}, 3, seed);
}

vec4 opaque(const vec3& color) {
    return {color, 1.0F};
}

/// 1 inside of a shape whose signed distance is negative, with an edge as wide as `edge`.
float inside(float distance, float edge) {
    return 1.0F - softStep(-edge, edge, distance);
}

}  // namespace

Texture parquetColor() {
    return paintTexture("parquet colour", 512, 512, [](const vec2& uv) {
        const Plank plank = plankAt(uv);
        const float tone = hashed(plank.column, plank.row, 1);
        const float grain = fibres(plank);
        vec3 color =
            glm::mix(vec3(0.64F, 0.53F, 0.42F), vec3(0.83F, 0.73F, 0.60F), 0.75F * tone + 0.25F * grain);
        color *= 0.82F + 0.3F * grain;
        return opaque(color * glm::mix(0.45F, 1.0F, softStep(0.0F, 0.06F, borderDistance(plank))));
    });
}

Texture parquetNormal() {
    return paintNormals("parquet normals", 512, 0.0012F, [](const vec2& uv) {
        const Plank plank = plankAt(uv);
        return softStep(0.0F, 0.09F, borderDistance(plank)) + 0.3F * fibres(plank);
    });
}

Texture parquetRoughness() {
    return paintTexture("parquet roughness", 512, 512, [](const vec2& uv) {
        const Plank plank = plankAt(uv);
        const float worn = fractalNoise(uv, {5, 5}, 3, 11);
        const float gap = 1.0F - softStep(0.0F, 0.08F, borderDistance(plank));
        const float roughness = 0.24F + 0.16F * worn + 0.08F * fibres(plank) + 0.3F * gap;
        return opaque(vec3(1.0F, roughness, 0.0F));
    });
}

Texture woodGrain() {
    return paintTexture("wood grain", 256, 256, [](const vec2& uv) {
        const float bend = 0.25F * fractalNoise(uv, {2, 1}, 3, 21);
        const float rings = 0.5F + 0.5F * std::sin(2.0F * kPi * (5.0F * uv.x + 4.0F * bend));
        const float pores = fractalNoise(uv, {48, 3}, 2, 22);
        const float tone = 0.45F * rings + 0.55F * pores;
        return opaque(glm::mix(vec3(0.36F, 0.22F, 0.13F), vec3(0.60F, 0.40F, 0.25F), tone));
    });
}

Texture fabricNormal() {
    return paintNormals("fabric normals", 128, 0.01F, [](const vec2& uv) {
        constexpr float kThreads = 16.0F;
        const vec2 p = uv * kThreads;
        const vec2 cell = glm::floor(p);
        const vec2 bump = glm::sin(kPi * (p - cell));
        const bool over = static_cast<int>(cell.x + cell.y) % 2 == 0;
        return over ? bump.x * (0.6F + 0.4F * bump.y) : bump.y * (0.6F + 0.4F * bump.x);
    });
}

Texture checkerTiles() {
    return paintTexture("checker tiles", 256, 256, [](const vec2& uv) {
        const vec2 p = 4.0F * uv;
        const vec2 cell = glm::floor(p);
        const vec2 q = p - cell;
        const auto x = static_cast<std::uint32_t>(cell.x);
        const auto y = static_cast<std::uint32_t>(cell.y);
        const vec3 clay = (x + y) % 2 == 0 ? vec3(0.80F, 0.74F, 0.66F) : vec3(0.62F, 0.36F, 0.26F);
        const float tone =
            0.9F + 0.2F * (hashed(x, y, 31) - 0.5F) + 0.12F * (fractalNoise(uv, {12, 12}, 3, 32) - 0.5F);
        const float border = std::min({q.x, 1.0F - q.x, q.y, 1.0F - q.y});
        return opaque(glm::mix(vec3(0.55F, 0.52F, 0.48F), clay * tone, softStep(0.015F, 0.035F, border)));
    });
}

Texture rugPattern() {
    return paintTexture("rug", 512, 384, [](const vec2& uv) {
        const vec3 cream{0.86F, 0.80F, 0.70F};
        const vec3 petrol{0.16F, 0.32F, 0.36F};
        const vec3 rust{0.70F, 0.34F, 0.20F};
        const vec3 ochre{0.82F, 0.60F, 0.30F};
        // Measured in the rug's height from its border, so that the frame is equally wide all round.
        const vec2 p = uv * vec2(4.0F / 3.0F, 1.0F);
        const float border = std::min({p.x, 4.0F / 3.0F - p.x, p.y, 1.0F - p.y});
        vec3 color = cream;
        const vec2 diamond = glm::abs(glm::fract(p * vec2(4.5F, 4.0F)) - 0.5F);
        const float ring = diamond.x + diamond.y;
        color = glm::mix(color, ochre, inside(std::abs(ring - 0.42F) - 0.035F, 0.02F));
        color = glm::mix(color, rust, inside(ring - 0.22F, 0.02F));
        color = glm::mix(color, petrol, inside(ring - 0.09F, 0.02F));
        const float frame = inside(border - 0.125F, 0.004F);
        color = glm::mix(color, petrol, frame);
        color = glm::mix(color, cream, inside(std::abs(border - 0.095F) - 0.008F, 0.003F));
        color = glm::mix(color, rust, inside(std::abs(border - 0.055F) - 0.015F, 0.003F));
        return opaque(color * (0.78F + 0.34F * fractalNoise(uv, {160, 120}, 2, 41)));
    });
}

Texture landscapePicture() {
    return paintTexture("landscape", 512, 360, [](const vec2& uv) {
        const float u = uv.x;
        const float v = uv.y;
        vec3 color = glm::mix(vec3(0.93F, 0.78F, 0.60F), vec3(0.97F, 0.90F, 0.76F), softStep(0.0F, 0.6F, v));
        const vec2 from_sun = (uv - vec2(0.64F, 0.36F)) * vec2(512.0F / 360.0F, 1.0F);
        color = glm::mix(color, vec3(0.86F, 0.33F, 0.18F), inside(glm::length(from_sun) - 0.19F, 0.004F));
        struct Hill {
            float height, swing, waves, phase;
            vec3 color;
        };
        const Hill hills[] = {{0.48F, 0.07F, 1.1F, 0.4F, {0.86F, 0.62F, 0.45F}},
                              {0.58F, 0.08F, 0.9F, 2.6F, {0.60F, 0.60F, 0.53F}},
                              {0.68F, 0.07F, 1.3F, 4.4F, {0.32F, 0.47F, 0.47F}},
                              {0.80F, 0.06F, 0.8F, 1.0F, {0.17F, 0.32F, 0.36F}},
                              {0.92F, 0.05F, 1.0F, 3.3F, {0.08F, 0.18F, 0.22F}}};
        for (const Hill& hill : hills) {
            const float edge =
                hill.height + hill.swing * std::sin(2.0F * kPi * hill.waves * u + hill.phase) +
                0.25F * hill.swing * std::sin(2.0F * kPi * 2.7F * hill.waves * u + 2.0F * hill.phase);
            color = glm::mix(color, hill.color, softStep(edge - 0.003F, edge + 0.003F, v));
        }
        return opaque(color * (0.93F + 0.1F * fractalNoise(uv, {90, 64}, 3, 51)));
    });
}

Texture leafCutout() {
    return paintTexture("leaf", 128, 256, [](const vec2& uv) {
        const float x = 2.0F * uv.x - 1.0F;
        const float length = 1.0F - uv.y;  // 0 at the stalk, 1 at the tip
        const float half_width =
            0.92F * std::sqrt(std::sin(kPi * std::pow(length, 0.8F)) + 0.0001F) * (1.0F - 0.35F * length);
        const float rib = std::abs(x);
        // Cuts that run from the border towards the midrib and upward, as a monstera's do.
        const float phase = glm::fract(7.0F * (length - 0.22F * rib));
        const bool cut = phase < 0.2F && rib > 0.4F && length > 0.15F && length < 0.85F;
        const bool leaf = rib < half_width && !cut;
        const float vein =
            std::max(inside(rib - 0.03F, 0.02F), 0.5F * inside(std::abs(phase - 0.65F) - 0.04F, 0.03F));
        const vec3 green =
            glm::mix(vec3(0.15F, 0.34F, 0.17F), vec3(0.30F, 0.50F, 0.24F), fractalNoise(uv, {6, 12}, 3, 71));
        return vec4(glm::mix(green, vec3(0.50F, 0.62F, 0.34F), 0.7F * vein), leaf ? 1.0F : 0.0F);
    });
}

}  // namespace licht::gallery
