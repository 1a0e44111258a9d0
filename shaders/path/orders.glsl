// Where light came from: sums over samples of every order T^i Le, and of what the clamp took. Tiles of the picture's size stand side by side in one
// image; a pixel is written by the one path that is followed for it.
#ifndef LICHT_PATH_ORDERS_GLSL
#define LICHT_PATH_ORDERS_GLSL
#include "path/path.glsl"
#include "path/store.glsl"
#include "pure/tiles.glsl"
#include "shared/bindings.h"
#include "shared/constants.h"
#include "shared/frame.h"

layout(constant_id = kConstantOrders) const uint kOrders = 0u;
layout(rgba32f, binding = kBindingOrderSums) uniform image2D order_sums;  // RGB: light; A: rays

void addToTile(uvec2 pixel, uint tile, vec4 value) {
    ivec2 at = tilePlace(imageSize(order_sums), frame.view.size, tile, pixel);
    imageStore(order_sums, at, imageLoad(order_sums, at) + value);
}

void noteOrder(uvec2 pixel, uint order, vec3 kept, vec3 lost) {
    if (kClamp && largest(lost) > 0.0 && allFinite(lost)) addToTile(pixel, kLostTile, vec4(lost, 0.0));
    if (order < kOrders && largest(kept) > 0.0 && allFinite(kept)) addToTile(pixel, order + (kClamp ? kLostTile + 1u : 0u), vec4(kept, 0.0));
}

void noteRays(uvec2 pixel, uint order, uint rays) {
    if (order < kOrders && rays > 0u) addToTile(pixel, order + (kClamp ? kLostTile + 1u : 0u), vec4(vec3(0.0), float(rays)));
}

#endif
