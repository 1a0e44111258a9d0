#pragma once
// The gallery's pictures and patterns, painted in code. Colours are sRGB-encoded as they are stored.
#include "licht/scene/scene.h"

namespace licht::gallery {

/// Herringbone parquet, one tile of kParquetTile metres; the three maps belong together.
inline constexpr float kParquetTile = 1.92F;
Texture parquetColor();
Texture parquetNormal();
Texture parquetRoughness();

Texture woodGrain();     ///< grain along v, tiles
Texture fabricNormal();  ///< a plain weave, tiles
Texture checkerTiles();  ///< four by four tiles
Texture rugPattern();
Texture landscapePicture();
Texture leafCutout();  ///< alpha is the leaf's outline; its stalk is at v = 1

}  // namespace licht::gallery
