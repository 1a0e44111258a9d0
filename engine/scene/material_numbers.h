#pragma once
// The numbers that glTF's extensions give a material: where they stand in a file, what they may be, and what
// they set. Loading and checking follow from the table; the default is what a Material begins with.
#include <limits>
#include <string_view>

#include "licht/scene/scene.h"

namespace licht {

struct MaterialNumber {
    std::string_view extension;
    std::string_view key;  ///< "x.y": the member y of the object x
    float least;
    float most;
    float& (*of)(Material&);
};

inline constexpr float kUnlimited = std::numeric_limits<float>::max();

/// No thin film is thicker (a millimetre, in nm), nor of a higher index: the square of their product is a
/// float.
inline constexpr float kMaxThinFilm = 1e6F;

inline constexpr MaterialNumber kMaterialNumbers[]{
    {"KHR_materials_specular", "specularFactor", 0, 1, [](Material& m) -> float& { return m.specular; }},
    {"KHR_materials_iridescence", "iridescenceFactor", 0, 1,
     [](Material& m) -> float& { return m.iridescence.factor; }},
    {"KHR_materials_iridescence", "iridescenceIor", 1, kMaxThinFilm,
     [](Material& m) -> float& { return m.iridescence.ior; }},
    {"KHR_materials_iridescence", "iridescenceThicknessMinimum", 0, kMaxThinFilm,
     [](Material& m) -> float& { return m.iridescence.thickness_minimum; }},
    {"KHR_materials_iridescence", "iridescenceThicknessMaximum", 0, kMaxThinFilm,
     [](Material& m) -> float& { return m.iridescence.thickness_maximum; }},
    {"KHR_materials_clearcoat", "clearcoatFactor", 0, 1,
     [](Material& m) -> float& { return m.clearcoat.factor; }},
    {"KHR_materials_clearcoat", "clearcoatRoughnessFactor", 0, 1,
     [](Material& m) -> float& { return m.clearcoat.roughness; }},
    {"KHR_materials_clearcoat", "clearcoatNormalTexture.scale", -kUnlimited, kUnlimited,
     [](Material& m) -> float& { return m.clearcoat.normal_scale; }},
};

}  // namespace licht
