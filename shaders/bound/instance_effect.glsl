// Whether meshes that are stored once and placed often are compiled in.
#ifndef LICHT_BOUND_INSTANCE_EFFECT_GLSL
#define LICHT_BOUND_INSTANCE_EFFECT_GLSL

layout(constant_id = 12) const bool kInstances = false;

#endif
