// What filters work on: pictures side by side in images. Light is of two kinds of lobes of the surface that the camera sees: those that spread it evenly and
// those that mirror it, more or less sharply.
#ifndef LICHT_SHARED_SIGNALS_H
#define LICHT_SHARED_SIGNALS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// Of one sample, in sample_signals.
LICHT_CONSTANT uint kSampleSeen = 0u;                     // light that comes straight to the camera
LICHT_CONSTANT uint kSampleToLight = kSampleSeen + 1u;    // light of the first ray to a light; what the picture has beside these came along the path
LICHT_CONSTANT uint kShareToLight = kSampleToLight + 1u;  // of that: what is spread evenly; A: what the path met next, instance + 1; 0: nothing
LICHT_CONSTANT uint kShareOnward = kShareToLight + 1u;    // likewise of the light along the path; A: how far it went to the next surface, metres; 0: nowhere
LICHT_CONSTANT uint kFirstSpread = kShareOnward + 1u;     // RGB: by what light spread evenly is demodulated; A: 1 where a surface is
LICHT_CONSTANT uint kFirstMirrored = kFirstSpread + 1u;   // RGB: and light mirrored; A: GGX width
LICHT_CONSTANT uint kFirstPlace = kFirstMirrored + 1u;    // XYZ: normal; W: depth along the axis
LICHT_CONSTANT uint kSampleTiles = kFirstPlace + 1u;

LICHT_CONSTANT float kFarthestOnward = 1e9f;  // metres: what is seen in the sky

// Sums over samples, in signal_sums. Samples fall into two halves that know nothing of each other: the second one's tile stands behind the first one's.
LICHT_CONSTANT uint kHalves = 2u;
LICHT_CONSTANT uint kSumSpread = 0u;
LICHT_CONSTANT uint kSumMirrored = kSumSpread + kHalves;
LICHT_CONSTANT uint kSumSeen = kSumMirrored + kHalves;     // light that comes straight to the camera
LICHT_CONSTANT uint kSumFirstSpread = kSumSeen + kHalves;  // of both halves from here on
LICHT_CONSTANT uint kSumFirstMirrored = kSumFirstSpread + 1u;
LICHT_CONSTANT uint kSumFirstPlace = kSumFirstMirrored + 1u;
LICHT_CONSTANT uint kSumSurface = kSumFirstPlace + 1u;  // no sums; X: what the last sample showed, instance + 1 (0: nothing); Y: 1 where all showed that;
                                                        // Z, W: how far from there its path met the next surface, instance + 1
LICHT_CONSTANT uint kSumTiles = kSumSurface + 1u;

// What earlier views have told, in history as they saw it and in prior as this view sees it. RGB: demodulated light, mean of A samples.
LICHT_CONSTANT uint kPriorSpread = 0u;  // a half behind the other
LICHT_CONSTANT uint kPriorMirrored = kPriorSpread + kHalves;
LICHT_CONSTANT uint kPriorTiles = kPriorMirrored + kHalves;
LICHT_CONSTANT uint kHistoryPlace = kPriorTiles;           // in history alone. XYZ: normal; W: depth along the axis, 0: nothing can be had here
LICHT_CONSTANT uint kHistorySurface = kHistoryPlace + 1u;  // X, Z, W: as in kSumSurface; Y: 1 where the pixels around show the same smooth surface
LICHT_CONSTANT uint kHistoryTiles = kHistorySurface + 1u;

// What is filtered, in filter_even and filter_odd. RGB: demodulated light; A: its variance, the mean of the channels'.
LICHT_CONSTANT uint kFilterSpread = 0u;  // a half behind the other
LICHT_CONSTANT uint kFilterMirrored = kFilterSpread + kHalves;
LICHT_CONSTANT uint kFilterCentre = kFilterMirrored + kHalves;  // XY: the share of a pixel's own light in both kinds; ZW: the variances of a sample
LICHT_CONSTANT uint kFilterTiles = kFilterCentre + 1u;

// What tells surfaces apart, in filter_guide.
LICHT_CONSTANT uint kGuidePlace = 0u;  // XYZ: normal; W: 1 / depth, which is linear over a plane's picture, or under an orthographic camera depth; 0: none
LICHT_CONSTANT uint kGuideSlope = 1u;  // XY: its change from pixel to pixel
LICHT_CONSTANT uint kGuideTiles = 2u;

// Of pixels at edges, in edge_parts: which pixel each part of them is drawn from, by its number among the nine around, row by row.
LICHT_CONSTANT uint kEdgeParts = 4u;
LICHT_CONSTANT uint kEdgeMark = kEdgeParts;  // 1: at an edge
LICHT_CONSTANT uint kEdgeTiles = kEdgeMark + 1u;
LICHT_CONSTANT int kEdgeSelf = 4;

// How far the light changed, in gradients_even and gradients_odd: a texel for a square of so many pixels a side. X: change over the larger
// of the light before and now, Y: its square, Z: 1; sums of them over the texels around.
LICHT_CONSTANT uint kGradientSide = 5u;

struct GradientPush {
    uint sample_index;  // that was drawn last
    uint stride;        // of sums
};

// Push constants of the filter's passes.
struct FilterPush {
    uvec2 size;         // of the picture
    uint orthographic;  // 1: so is the camera
    uint stride;        // between taps, in pixels
    float count_a;      // samples of this view in the halves, at least one in both together
    float count_b;
};

// Push constants of the pass that brings the history to a new view.
struct ReprojectPush {
    uint sample_index;  // of the view's first sample
    uint fresh;         // 1: there is no history
    uint changed;       // 1: the scene is another than that of the view before, and gradients say how far
};

LICHT_SHARED_END
#endif
