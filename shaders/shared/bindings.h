// Places of buffers and images. The host finds them by the name in the shader; these numbers only have to differ.
#ifndef LICHT_SHARED_BINDINGS_H
#define LICHT_SHARED_BINDINGS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// Each is one more than the one before, so that no two are the same.
// The scene.
LICHT_CONSTANT uint kBindingFrame = 0u;
LICHT_CONSTANT uint kBindingVertices = kBindingFrame + 1u;
LICHT_CONSTANT uint kBindingTriangleIndices = kBindingVertices + 1u;
LICHT_CONSTANT uint kBindingInstances = kBindingTriangleIndices + 1u;
LICHT_CONSTANT uint kBindingInstanceTransforms = kBindingInstances + 1u;
LICHT_CONSTANT uint kBindingMaterials = kBindingInstanceTransforms + 1u;
LICHT_CONSTANT uint kBindingMaterialDetails = kBindingMaterials + 1u;
LICHT_CONSTANT uint kBindingTangents = kBindingMaterialDetails + 1u;
LICHT_CONSTANT uint kBindingColors = kBindingTangents + 1u;
LICHT_CONSTANT uint kBindingExtraUvs = kBindingColors + 1u;
LICHT_CONSTANT uint kBindingTextures = kBindingExtraUvs + 1u;
LICHT_CONSTANT uint kBindingTexelPages = kBindingTextures + 1u;
LICHT_CONSTANT uint kBindingSrgbTable = kBindingTexelPages + 1u;
LICHT_CONSTANT uint kBindingLights = kBindingSrgbTable + 1u;
LICHT_CONSTANT uint kBindingLightAlias = kBindingLights + 1u;
LICHT_CONSTANT uint kBindingLightTree = kBindingLightAlias + 1u;
LICHT_CONSTANT uint kBindingEnvironmentTable = kBindingLightTree + 1u;
LICHT_CONSTANT uint kBindingEnvironmentMap = kBindingEnvironmentTable + 1u;

// The same records as texels (scene_data.glsl).
LICHT_CONSTANT uint kBindingVertexTexels = kBindingEnvironmentMap + 1u;
LICHT_CONSTANT uint kBindingTriangleIndexTexels = kBindingVertexTexels + 1u;
LICHT_CONSTANT uint kBindingInstanceTexels = kBindingTriangleIndexTexels + 1u;
LICHT_CONSTANT uint kBindingMaterialTexels = kBindingInstanceTexels + 1u;
LICHT_CONSTANT uint kBindingMaterialDetailTexels = kBindingMaterialTexels + 1u;
LICHT_CONSTANT uint kBindingLightTexels = kBindingMaterialDetailTexels + 1u;
LICHT_CONSTANT uint kBindingLightAliasTexels = kBindingLightTexels + 1u;
LICHT_CONSTANT uint kBindingLightTreeTexels = kBindingLightAliasTexels + 1u;

// The tree, as texels or as storage.
LICHT_CONSTANT uint kBindingBvhNodes = kBindingLightTreeTexels + 1u;
LICHT_CONSTANT uint kBindingBvhNodesStorage = kBindingBvhNodes + 1u;
LICHT_CONSTANT uint kBindingBvhTriangles = kBindingBvhNodesStorage + 1u;
LICHT_CONSTANT uint kBindingBvhTrianglesStorage = kBindingBvhTriangles + 1u;

// Images of the picture's size, and what is beside them.
LICHT_CONSTANT uint kBindingGbuffer = kBindingBvhTrianglesStorage + 1u;
LICHT_CONSTANT uint kBindingRadiance = kBindingGbuffer + 1u;
LICHT_CONSTANT uint kBindingMeanHigh = kBindingRadiance + 1u;
LICHT_CONSTANT uint kBindingMeanLow = kBindingMeanHigh + 1u;
LICHT_CONSTANT uint kBindingSquaresHigh = kBindingMeanLow + 1u;
LICHT_CONSTANT uint kBindingSquaresLow = kBindingSquaresHigh + 1u;
LICHT_CONSTANT uint kBindingAovAlbedo = kBindingSquaresLow + 1u;
LICHT_CONSTANT uint kBindingAovNormal = kBindingAovAlbedo + 1u;
LICHT_CONSTANT uint kBindingAovMotion = kBindingAovNormal + 1u;
LICHT_CONSTANT uint kBindingDisplay = kBindingAovMotion + 1u;
LICHT_CONSTANT uint kBindingOrderSums = kBindingDisplay + 1u;
LICHT_CONSTANT uint kBindingSampleSignals = kBindingOrderSums + 1u;
LICHT_CONSTANT uint kBindingSignalSums = kBindingSampleSignals + 1u;
LICHT_CONSTANT uint kBindingHistory = kBindingSignalSums + 1u;
LICHT_CONSTANT uint kBindingPrior = kBindingHistory + 1u;
LICHT_CONSTANT uint kBindingFilterGuide = kBindingPrior + 1u;
LICHT_CONSTANT uint kBindingFilterFrom = kBindingFilterGuide + 1u;
LICHT_CONSTANT uint kBindingFilterTo = kBindingFilterFrom + 1u;
LICHT_CONSTANT uint kBindingSmoothFrom = kBindingFilterTo + 1u;
LICHT_CONSTANT uint kBindingSmoothTo = kBindingSmoothFrom + 1u;
LICHT_CONSTANT uint kBindingGradientsFrom = kBindingSmoothTo + 1u;
LICHT_CONSTANT uint kBindingGradientsTo = kBindingGradientsFrom + 1u;
LICHT_CONSTANT uint kBindingPreviousVertices = kBindingGradientsTo + 1u;
LICHT_CONSTANT uint kBindingPreviousInstanceTransforms = kBindingPreviousVertices + 1u;
LICHT_CONSTANT uint kBindingEdgeParts = kBindingPreviousInstanceTransforms + 1u;
LICHT_CONSTANT uint kBindingUnresolved = kBindingEdgeParts + 1u;
LICHT_CONSTANT uint kBindingUnresolvedError = kBindingUnresolved + 1u;
LICHT_CONSTANT uint kBindingFiltered = kBindingUnresolvedError + 1u;
LICHT_CONSTANT uint kBindingFilteredError = kBindingFiltered + 1u;
LICHT_CONSTANT uint kBindingAdaptiveTiles = kBindingFilteredError + 1u;
LICHT_CONSTANT uint kBindingCounters = kBindingAdaptiveTiles + 1u;

// Queues.
LICHT_CONSTANT uint kBindingQueueCounts = kBindingCounters + 1u;
LICHT_CONSTANT uint kBindingQueuePaths = kBindingQueueCounts + 1u;
LICHT_CONSTANT uint kBindingQueueHits = kBindingQueuePaths + 1u;
LICHT_CONSTANT uint kBindingQueueRays = kBindingQueueHits + 1u;
LICHT_CONSTANT uint kBindingQueueShadows = kBindingQueueRays + 1u;
LICHT_CONSTANT uint kBindingQueuePathTexels = kBindingQueueShadows + 1u;
LICHT_CONSTANT uint kBindingQueueHitTexels = kBindingQueuePathTexels + 1u;
LICHT_CONSTANT uint kBindingQueueRayTexels = kBindingQueueHitTexels + 1u;
LICHT_CONSTANT uint kBindingQueueShadowTexels = kBindingQueueRayTexels + 1u;
LICHT_CONSTANT uint kBindingQueueGroups = kBindingQueueShadowTexels + 1u;

// Lists of rays.
LICHT_CONSTANT uint kBindingRayRange = kBindingQueueGroups + 1u;
LICHT_CONSTANT uint kBindingRayTexels = kBindingRayRange + 1u;
LICHT_CONSTANT uint kBindingRayHits = kBindingRayTexels + 1u;

// From here on: of the kernel that includes the others.
LICHT_CONSTANT uint kFirstFreeBinding = kBindingRayHits + 1u;

LICHT_SHARED_END
#endif
