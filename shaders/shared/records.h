// Every record that C++ writes and GLSL reads, or the other way round. std430 rules: a vec3 is followed by a scalar, so that both
// languages agree on every offset without padding that nobody named.
#ifndef LICHT_SHARED_RECORDS_H
#define LICHT_SHARED_RECORDS_H
#include "seam.h"

LICHT_SHARED_BEGIN

LICHT_CONSTANT uint kNoIndex = 0xffffffffu;

// A vertex, in world space unless its mesh is instanced: then in object space, seen from the mesh's centre. TEXCOORD_0 rides along; further sets,
// tangents and colours have buffers of their own, present only when called for.
struct VertexRecord {
    vec3 position;
    float u;
    vec3 normal;  // unit; zero: shade flat
    float v;
};

LICHT_CONSTANT uint kInstanceDoubleSided = 1u;
LICHT_CONSTANT uint kInstanceAlpha = 2u;
LICHT_CONSTANT uint kInstanceTangents = 4u;

struct InstanceRecord {
    uint first_triangle;  // into the triangle indices
    uint material;
    uint first_light;  // light index of primitive 0; kNoIndex: its triangles are not in the light table
    uint flags;
};

// Where an instance of a mesh stands: world = (dot(world_x, object), ...) + pivot. The way back is with the BVH, for rays alone.
struct InstanceTransformRecord {
    vec3 world_x;
    float pivot_x;
    vec3 world_y;
    float pivot_y;
    vec3 world_z;
    float pivot_z;
    float condition;  // how much rounding grows on the way to the object: the product of both matrices' largest row sums of magnitudes
    uint mirrored;    // 1: the transform turns fronts into backs
    uint reserved0;
    uint reserved1;
};

// Kinds of texture slots.
LICHT_CONSTANT uint kSlotBaseColor = 0u;
LICHT_CONSTANT uint kSlotMetallicRoughness = 1u;
LICHT_CONSTANT uint kSlotNormal = 2u;
LICHT_CONSTANT uint kSlotEmissive = 3u;
LICHT_CONSTANT uint kSlotSpecular = 4u;
LICHT_CONSTANT uint kSlotSpecularColor = 5u;
LICHT_CONSTANT uint kSlotIridescence = 6u;
LICHT_CONSTANT uint kSlotIridescenceThickness = 7u;

LICHT_CONSTANT uint kSlotLinear = 1u;      // bilinear filter
LICHT_CONSTANT uint kSlotWrapUShift = 1u;  // two bits each: 0 repeat, 1 clamp, 2 mirror
LICHT_CONSTANT uint kSlotWrapVShift = 3u;
LICHT_CONSTANT uint kSlotSrgb = 32u;  // decode RGB by the sRGB curve
LICHT_CONSTANT uint kSlotUvSetShift = 8u;

struct TextureSlotRecord {
    vec3 u_from_uv;
    uint texture;  // kNoIndex: none
    vec3 v_from_uv;
    uint flags;
};

LICHT_CONSTANT uint kTexelsPerPageLog2 = 24u;  // 64 MiB of RGBA8 a page: half the storage buffer that every device guarantees
LICHT_CONSTANT uint kTexturePages = 8u;

struct TextureRecord {
    uint page;
    uint first_word;
    uint width;
    uint height;
    uint words_per_texel;  // 1: RGBA8, 2: RGBA16
    uint reserved0;
    uint reserved1;
    uint reserved2;
};

LICHT_CONSTANT uint kMaterialUnlit = 1u;
LICHT_CONSTANT uint kMaterialAlphaMask = 2u;
LICHT_CONSTANT uint kMaterialAlphaBlend = 4u;
LICHT_CONSTANT uint kMaterialDoubleSided = 8u;

struct MaterialRecord {
    vec4 base_color;
    vec3 emission;  // cd/m^2
    float metallic;
    vec3 specular_color;
    float roughness;
    float specular;
    float dielectric_f0;  // ((ior - 1) / (ior + 1))^2
    float normal_scale;
    float alpha_cutoff;
    uint flags;
    float iridescence;
    float iridescence_ior;
    float iridescence_thickness_minimum;  // nm
    float iridescence_thickness_maximum;  // and without a texture
    uint reserved0;
    uint reserved1;
    uint reserved2;
    TextureSlotRecord base_color_slot;
    TextureSlotRecord metallic_roughness_slot;
    TextureSlotRecord normal_slot;
    TextureSlotRecord emissive_slot;
    TextureSlotRecord specular_slot;
    TextureSlotRecord specular_color_slot;
    TextureSlotRecord iridescence_slot;
    TextureSlotRecord iridescence_thickness_slot;
};
LICHT_CONSTANT uint kMaterialTexels = 22u;  // of four words

LICHT_CONSTANT uint kLightTriangle = 0u;
LICHT_CONSTANT uint kLightPoint = 1u;
LICHT_CONSTANT uint kLightSpot = 2u;
LICHT_CONSTANT uint kLightDirectional = 3u;
LICHT_CONSTANT uint kLightEnvironment = 4u;
LICHT_CONSTANT uint kLightRectangle = 5u;
LICHT_CONSTANT uint kLightSphere = 6u;  // a round mesh, by the sphere around it
LICHT_CONSTANT uint kLightKindMask = 0xffu;
LICHT_CONSTANT uint kLightDoubleSided = 0x100u;  // flags beside the kind
LICHT_CONSTANT uint kLightTextured = 0x200u;

struct LightRecord {
    vec3 position;     // punctual: world; triangle, rectangle: the first corner; sphere: the centre
    uint kind;         // and flags
    vec3 direction;    // the way the light travels, unit; triangle, rectangle: the edge from the first corner to the second, metres
    float range;       // metres; 0: unlimited; sphere: its radius
    vec3 intensity;    // cd, or lux when directional; triangle, rectangle: the edge from the first corner to the last
    float cone_scale;  // spot: smooth factor = clamp(cos * scale + offset, 0, 1)^2; directional: sine squared of the half angle it fills
    vec3 emission;     // triangle, rectangle, sphere: cd/m^2, before a texture
    float cone_offset;
    uint instance;  // triangle: its hit record; sphere: the instance, and primitive 0
    uint primitive;
    float pmf;   // probability that the table picks this light, or the tree that it is in
    uint trail;  // in the tree: which child at which level, kLightTrailBits each
};
LICHT_CONSTANT uint kLightTexels = 5u;

// The light tree: four children a node. Two levels of a binary tree ask as many clusters for their importance and know less of them.
LICHT_CONSTANT uint kLightChildren = 4u;
LICHT_CONSTANT uint kLightTrailBits = 2u;

// A child, whose intensity is 0 where there is none: a bounding box, a cone of normals, and how far light reaches around them.
struct LightChildRecord {
    vec3 centre;      // world
    float intensity;  // cd, of all lights below, if all their normals were one
    vec3 half_size;
    float mean_normal;  // length of the mean of the normals, were they even over their cone
    vec3 axis;          // unit
    float cos_reach;    // of the angle to the axis within which any light leaves, at most pi
    float sin_reach;
    uint next;        // index of a node or, with kLightLeaf, of a light; flags
    float radius;     // of the sphere around the box
    float softening;  // added to the distance's square: lights of a wide cluster are not all at its centre; 0 for a point
};
LICHT_CONSTANT uint kLightChildTexels = 4u;
LICHT_CONSTANT uint kLightLeaf = 0x80000000u;
LICHT_CONSTANT uint kLightTwoSided = 0x40000000u;
LICHT_CONSTANT uint kLightIndexMask = 0x3fffffffu;
// Added to cosines, so that rounding and the packing of normals (3e-5) never hide a light that is barely seen.
LICHT_CONSTANT float kLightSlack = 1e-4F;
// Of a cluster's importance; all four are the flat optimum for a hall of 200 lamps.
LICHT_CONSTANT float kLightLeastReceived = 0.2F;  // of the sine of its sphere's angular radius, where the mean is less
LICHT_CONSTANT float kLightLeastEmitted = 0.1F;   // of the emission, where the mean is less
LICHT_CONSTANT float kLightSoftening = 0.4F;      // of its radius's square, in that of the distance
LICHT_CONSTANT float kLightWidening = 0.25F;      // of that sine's square, in that of a coat's width

// One column of an alias table (Walker 1974; Vose 1991): keep this entry when u < threshold, else take `alias`.
struct AliasRecord {
    float threshold;
    uint alias;
    float pmf;
    uint reserved;
};

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
    uvec2 size;   // pixels
    float z_far;  // orthographic: beyond everything; perspective has no far plane
    uint reserved;
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
    uint reserved0;
    uint reserved1;
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

// The first dimensions of a sample belong to the camera, then each bounce takes its own few.
LICHT_CONSTANT uint kDimensionCamera = 0u;
LICHT_CONSTANT uint kDimensionBounce = 1u;  // + kDimensionsPerBounce * bounce + one of these:
LICHT_CONSTANT uint kDimensionLight = 0u;
LICHT_CONSTANT uint kDimensionScatter = 1u;  // and roulette
LICHT_CONSTANT uint kDimensionEnvironment = 2u;
LICHT_CONSTANT uint kDimensionsPerBounce = 3u;
LICHT_CONSTANT uint kDimensionAlpha = 0x80000000u;  // + rays traced so far: coverage of partly transparent surfaces

// How direct light is found: lights and scattering combined, scattering alone (the integral over the hemisphere), or lights alone (over surfaces).
LICHT_CONSTANT uint kDirectMis = 0u;
LICHT_CONSTANT uint kDirectHemisphere = 1u;
LICHT_CONSTANT uint kDirectArea = 2u;

// How one light is picked of many.
LICHT_CONSTANT uint kLightsTree = 0u;
LICHT_CONSTANT uint kLightsPower = 1u;
LICHT_CONSTANT uint kLightsUniform = 2u;

LICHT_CONSTANT uint kEnvironmentAlias = 0u;
LICHT_CONSTANT uint kEnvironmentInversion = 1u;
LICHT_CONSTANT uint kEnvironmentRejection = 2u;
LICHT_CONSTANT uint kEnvironmentUnits = 0x80000000u;  // the whole of a distribution function
LICHT_CONSTANT uint kEnvironmentMostTries = 32u;

LICHT_CONSTANT uint kSamplerSobol = 0u;
LICHT_CONSTANT uint kSamplerBlue = 1u;
LICHT_CONSTANT uint kSamplerRandom = 2u;

// Specialisation constants beside the effects.
LICHT_CONSTANT uint kConstantDirect = 32u;
LICHT_CONSTANT uint kConstantMisBalance = 33u;
LICHT_CONSTANT uint kConstantLights = 34u;
LICHT_CONSTANT uint kConstantEnvironmentSampling = 35u;
LICHT_CONSTANT uint kConstantSampler = 36u;
LICHT_CONSTANT uint kConstantBlueBits = 37u;  // log2 of the samples whose error is blue together
LICHT_CONSTANT uint kConstantClamp = 38u;
LICHT_CONSTANT uint kConstantRegularise = 39u;
LICHT_CONSTANT uint kConstantOrders = 40u;    // layers of the orders T^i Le: 0 none, else bounces + 1
LICHT_CONSTANT uint kConstantAdaptive = 41u;  // pixels are sampled where a mask says so
LICHT_CONSTANT uint kLostTile = 0u;           // of the sums beside the picture, where the clamp is on; the orders come behind it
LICHT_CONSTANT uint kConstantBvhInStorage = 64u;
LICHT_CONSTANT uint kConstantBvhStackSize = 65u;
LICHT_CONSTANT uint kConstantTexturePages = 66u;
LICHT_CONSTANT uint kConstantTextureSlotKinds = 67u;
LICHT_CONSTANT uint kConstantWideTexels = 68u;
LICHT_CONSTANT uint kConstantBakedInstances = 69u;
LICHT_CONSTANT uint kConstantFirstInstancePosition = 70u;
LICHT_CONSTANT uint kConstantInstanceSlack = 71u;  // the bits of a float
LICHT_CONSTANT uint kConstantFirstInstanceTexel = 79u;
LICHT_CONSTANT uint kConstantPathsPerThread = 72u;
LICHT_CONSTANT uint kConstantSceneInStorage = 73u;

// Counted on the device, summed on the host.
struct CounterRecord {
    uint bounce_rays;
    uint shadow_rays;
    uint nonfinite_samples;
    uint cut_walks;            // samples in which the driver ended a traversal before it was done
    uint environment_samples;  // directions drawn by rejection, and how many were tried for them
    uint environment_tries;
};

struct TonemapPush {
    float exposure;  // factor 2^EV
    uint curve;      // kTonemap...
};

LICHT_CONSTANT uint kTonemapNone = 0u;
LICHT_CONSTANT uint kTonemapNeutral = 1u;
LICHT_CONSTANT uint kTonemapAgx = 2u;
LICHT_CONSTANT uint kTonemapAces = 3u;

LICHT_SHARED_END
#endif
