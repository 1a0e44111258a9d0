// Whether meshes that are stored once and placed often are compiled in.
#ifndef LICHT_BOUND_INSTANCE_EFFECT_GLSL
#define LICHT_BOUND_INSTANCE_EFFECT_GLSL
#include "shared/effects.h"

layout(constant_id = kEffectInstances) const bool kInstances = false;

#endif
