// Pictures of one size, side by side in one image.
#ifndef LICHT_PURE_TILES_GLSL
#define LICHT_PURE_TILES_GLSL

// Where a picture begins; size: of a picture. Divides, so what loops over pixels asks for it once.
ivec2 tileOrigin(ivec2 image_size, uvec2 size, uint tile) {
    uint columns = uint(image_size.x) / size.x;
    return ivec2(uvec2(tile % columns, tile / columns) * size);
}

// Where a picture's pixel lies.
ivec2 tilePlace(ivec2 image_size, uvec2 size, uint tile, uvec2 pixel) { return tileOrigin(image_size, size, tile) + ivec2(pixel); }

#endif
