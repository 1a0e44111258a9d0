#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
// A path a pixel, from the G-buffer's hit.
#include "path/wavefront.glsl"
#include "shared/index.h"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    uvec2 pixel = pixelOfThread();
    uint path = pathOfThread();
    bool hits = false;
    if (insideSlice(pixel) && isSampled(pixel, frame.view.size.x, push.sample_index)) {
        beginSignals(pixel);
        Hit hit = gbufferHit(ivec2(pixel));
        Path p = beginPath(sampleAddress(pixel, push.sample_index), hit, gbufferWo(hit, ivec2(pixel), push.sample_index));
        hits = hit.instance != kNoIndex;
        if (!hits) endInSky(p);
        packRadiance(path, p.radiance, p.from.normal);
        packPath(path, p);
        packHit(path, hit);
    }
    uint place = enqueue(0u, kCountHits, path, hits);
    if (hits) queue_hits[place] = path;
    endBalance();
}
