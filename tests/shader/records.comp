#version 460
#extension GL_GOOGLE_include_directive : require
// Declares every record as the shaders do, for the comparison with their C++ twins.
#include "shared/bvh_layout.h"
#include "shared/counters.h"
#include "shared/device_check.h"
#include "shared/frame.h"
#include "shared/geometry.h"
#include "shared/light.h"
#include "shared/material.h"
#include "shared/path.h"
#include "shared/ray_records.h"
#include "shared/signals.h"

layout(local_size_x = 1) in;

layout(push_constant) uniform Push { SamplePush sample_push; TonemapPush tonemap_push; WavefrontPush wavefront_push; FilterPush filter_push; ReprojectPush reproject_push; GradientPush gradient_push; };
layout(std430, binding = 0) readonly buffer FrameBlock { FrameRecord frame; };  // with its ViewRecord
layout(std430, binding = 1) readonly buffer Vertices { VertexRecord vertices[]; };
layout(std430, binding = 2) readonly buffer Instances { InstanceRecord instances[]; };
layout(std430, binding = 3) readonly buffer Slots { TextureSlotRecord slots[]; };
layout(std430, binding = 4) readonly buffer Textures { TextureRecord textures[]; };
layout(std430, binding = 5) readonly buffer Materials { MaterialRecord materials[]; };
layout(std430, binding = 6) readonly buffer Lights { LightRecord lights[]; };
layout(std430, binding = 15) readonly buffer LightTree { LightChildRecord light_tree[]; };
layout(std430, binding = 7) readonly buffer Alias { AliasRecord alias[]; };
layout(std430, binding = 8) buffer Counters { CounterRecord counters; };
layout(std430, binding = 9) readonly buffer Nodes { BvhNode nodes[]; };
layout(std430, binding = 10) readonly buffer Transforms { InstanceTransformRecord transforms[]; };
layout(std430, binding = 11) readonly buffer AdaptiveTiles { AdaptiveTileRecord adaptive_tiles[]; };
layout(std430, binding = 12) readonly buffer Rays { RayRecord rays[]; };
layout(std430, binding = 13) readonly buffer RayHits { RayHitRecord ray_hits[]; };
layout(std430, binding = 16) readonly buffer Iridescence { IridescenceRecord iridescence[]; };
layout(std430, binding = 17) readonly buffer Clearcoats { ClearcoatRecord clearcoats[]; };
layout(std430, binding = 18) readonly buffer Questions { CheckQuestion questions[]; };
layout(std430, binding = 19) readonly buffer Answers { CheckAnswer answers[]; };
layout(std430, binding = 20) readonly buffer Ballots { BallotAnswer ballots[]; };
layout(std430, binding = 14) readonly buffer Range { RayRange range; };

void main() {}
