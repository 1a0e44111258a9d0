#version 460
#extension GL_GOOGLE_include_directive : require
// Draws the parts of pixels at edges from the pixels that history_parts.comp found for them, beside the pixel's own samples.
#include "filter/filter.glsl"

layout(r32f, binding = kBindingEdgeParts) uniform readonly image2D edge_parts;
layout(rgba32f, binding = kBindingUnresolved) uniform readonly image2D unresolved;
layout(rgba32f, binding = kBindingUnresolvedError) uniform readonly image2D unresolved_error;
layout(rgba32f, binding = kBindingFiltered) uniform writeonly image2D filtered;
layout(rgba32f, binding = kBindingFilteredError) uniform writeonly image2D filtered_error;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!isInside(pixel)) return;
    vec4 own = imageLoad(unresolved, pixel), error = imageLoad(unresolved_error, pixel);
    vec4 picture = own;
    if (tileTexel(edge_parts, kEdgeMark, pixel).x > 0.0) {
        vec4 sum = vec4(0.0);
        vec3 squares = vec3(0.0);
        for (uint part = 0u; part < kEdgeParts; ++part) {
            int source = int(tileTexel(edge_parts, part, pixel).x);
            vec4 there = imageLoad(unresolved, pixel + ivec2(source % 3, source / 3) - 1);
            sum += there;
            squares += there.rgb * there.rgb;
        }
        // By numbers of samples, so that what the parts bring falls as the pixel's own grow in number.
        const float kParts = float(kEdgeParts);
        float samples = push.count_a + push.count_b, share = kParts / (kParts + samples);
        vec4 mean = sum / kParts;
        picture = mix(own, mean, share);
        error.rgb += share * share * max(squares / kParts - mean.rgb * mean.rgb, vec3(0.0)) / (kParts - 1.0);
    }
    imageStore(filtered, pixel, picture);
    imageStore(filtered_error, pixel, error);
}
