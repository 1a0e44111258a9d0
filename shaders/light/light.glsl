// All lights, by three verbs: what one sends, a sample of one as seen from a vertex, and its density for what scattering found. A kind of light has a view of
// its record in light_views.h, a file here with these verbs, and its line in each function below.
#ifndef LICHT_LIGHT_LIGHT_GLSL
#define LICHT_LIGHT_LIGHT_GLSL

#include "light/pick.glsl"
#include "light/punctual.glsl"
#include "light/shape.glsl"
#include "light/sky.glsl"
#include "light/sphere.glsl"
#include "light/sun.glsl"
#include "shared/dimensions.h"

// Density, by solid angle, with which light sampling at `at` would have found the emitting point `s`; 0: never.
float pdfOfSurface(Surface s, PackedShadingPoint at) {
    if (!kLightTriangles || s.light == kNoIndex) return 0.0;
    LightRecord light = lightAt(s.light);
    float pmf = pmfOfLight(light, s.light, at);
    if (kLightSpheres && kindOf(light) == kLightSphere) return pdfOfSphere(light, pmf, at.position);
    return pdfOfShape(light, pmf, at.position, s.position - at.position);
}

float pdfOfSky(vec3 direction) {
    return frame.environment_light == kNoIndex ? 0.0 : lightAt(frame.environment_light).pmf * pdfEnvironment(direction);
}

LightSample sampleSky(float pmf, uvec4 bits) {
    EnvironmentSample e = sampleEnvironment(bits);
    LightSample s = lightSample(e.direction, infinity(), environmentRadiance(e.direction), pmf * e.pdf, false, e.pdf > 0.0);
    s.tries = e.tries;
    return s;
}

// dimension: the first of the bounce.
LightSample sampleLight(Vertex from, PackedShadingPoint at, SampleAddress address, uint dimension) {
    if (frame.light_slots == 0u) return kNoLight;
    vec4 u = sample4(address, dimension + kDimensionLight);  // xy: where on the light; zw: which one
    LightPick pick = pickLight(at, u.zw);
    if (pick.light == kNoIndex) return kNoLight;
    LightRecord light = lightAt(pick.light);
    float pmf = kLights == kLightsTree ? light.pmf * pick.pmf : light.pmf;
    uint kind = kindOf(light);
    if (kLightTriangles && (kind == kLightTriangle || kind == kLightRectangle)) return sampleShape(light, pmf, from, u.xy);
    if (kLightSpheres && kind == kLightSphere) return sampleSphere(light, pmf, from, u.xy);
    if (kEnvironment && kind == kLightEnvironment) return sampleSky(pmf, sampleBits4(address, dimension + kDimensionSky));
    if (kPunctualLights && kind == kLightDirectional) return sampleSun(light, u.xy);
    if (kPunctualLights) return sampleSpot(light, pmf, from);
    return kNoLight;
}

#endif
