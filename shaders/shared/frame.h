// What a frame and its passes are told.
#ifndef LICHT_SHARED_FRAME_H
#define LICHT_SHARED_FRAME_H
#include "index.h"

LICHT_SHARED_BEGIN

// The camera. All directions in world space; positions are taken relative to the eye before anything is rotated, so that a scene far from
// the origin loses no bits.
struct ViewRecord {
    vec3 eye;
    uint orthographic;
    vec3 right;     // unit
    float scale_x;  // perspective: tan(half angle); orthographic: half width
    vec3 up;        // unit
    float scale_y;
    vec3 back;  // unit: the camera looks along -back
    float z_near;
    uvec2 size;     // pixels
    float z_far;    // orthographic: beyond everything; perspective has no far plane
    float z_limit;  // along the axis; nothing farther is seen; infinity: no such limit
};

struct FrameRecord {
    ViewRecord view;
    ViewRecord previous_view;
    uint light_slots;        // columns of the alias table over lights: one a light, or one for all in the tree and one for each that is not
    uint environment_light;  // index in the light table; kNoIndex: none
    uvec2 environment_size;
    uint bounces;
    uint roulette_start;  // first bounce that may end a path by chance
    uint seed;
    uint extra_uv_sets;
    uint has_sky;            // 1: what hits nothing sees the environment, so the picture is opaque there
    float clamp_limit;       // cd/m^2, of what one indirect contribution may add to a pixel; read where kConstantClamp is set
    uint tree_lights;        // so many of the lights, the first ones, are picked by the tree; 0: none
    float environment_peak;  // largest density of a direction to it, 1/sr
    uint first_sun;          // of the lights; so many stand together
    uint suns;
    float environment_turn;  // of the map about +Y, counter-clockwise from above, in whole turns: [0,1)
    uint reserved0;
};

// Push constants of the passes that draw samples.
struct SamplePush {
    uint sample_index;  // address of the sample that is drawn
    uint count_before;  // samples already in the history
    uint first_row;     // of this slice
    uint row_count;
};

// A tile of pixels that are sampled alike.
LICHT_CONSTANT uint kAdaptiveTileSide = 8u;
struct AdaptiveTileRecord {
    uint end;     // frames from this one on pass it by
    uint behind;  // how far the numbers of its samples lag behind the frames'
};

struct TonemapPush {
    float exposure;  // factor 2^EV
    uint curve;      // kTonemap...
};

LICHT_CONSTANT uint kLostTile = 0u;  // of the sums beside the picture, where the clamp is on; the orders come behind it

LICHT_SHARED_END
#endif
