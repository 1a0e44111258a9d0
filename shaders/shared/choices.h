// What can be done in several ways, by number: values of specialisation and push constants.
#ifndef LICHT_SHARED_CHOICES_H
#define LICHT_SHARED_CHOICES_H
#include "seam.h"

LICHT_SHARED_BEGIN

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

LICHT_CONSTANT uint kSamplerSobol = 0u;
LICHT_CONSTANT uint kSamplerBlue = 1u;
LICHT_CONSTANT uint kSamplerRandom = 2u;

// What a layer leaves to what lies below: by directional albedos, so that both give what they get, that of the view alone or of both directions; or by glTF's
// formula.
LICHT_CONSTANT uint kLayeringView = 0u;
LICHT_CONSTANT uint kLayeringAlbedo = 1u;
LICHT_CONSTANT uint kLayeringGltf = 2u;

// How often light is followed between the microfacets of one spot.
LICHT_CONSTANT uint kEnergyMultiple = 0u;
LICHT_CONSTANT uint kEnergySingle = 1u;

LICHT_CONSTANT uint kTonemapNone = 0u;
LICHT_CONSTANT uint kTonemapNeutral = 1u;
LICHT_CONSTANT uint kTonemapAgx = 2u;
LICHT_CONSTANT uint kTonemapAces = 3u;

LICHT_SHARED_END
#endif
