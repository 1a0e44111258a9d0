// The rounding bounds that make the traversal lose no hit, for builder, CPU traversal and shader alike.
#ifndef LICHT_SHARED_BVH_NUMERICS_H
#define LICHT_SHARED_BVH_NUMERICS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// Vertices and ray origins beyond this are left out: (2 * 1.8e18)^2 * 6, the largest edge sum and box area, is still finite.
LICHT_CONSTANT float kBvhLargestCoordinate = 1.8e18F;

// 2^-80. A direction whose largest component is shorter counts as zero: its reciprocal times 2^40 (below) must stay finite.
LICHT_CONSTANT float kBvhShortestDirection = 8.271806125530277e-25F;

// 2^-40. Direction components below this share of the largest are lengthened to it for the box test alone, so that no zero meets an
// infinity. The ray moves by less than 2^-39 of its length, which kBvhShearSlack holds many times over.
LICHT_CONSTANT float kBvhFlattestDirection = 9.094947017729282e-13F;

// 2^-20 = 16 u (u = 2^-24). A sheared vertex is off by at most 2u |x| + 8u |z| (one subtraction; shear, product, difference; the shear's
// division may be off by 2.5 ulp on a device), so the boxes are widened sideways by twice that (Woop, Benthin, Wald 2013, section 4).
LICHT_CONSTANT float kBvhShearSlack = 9.5367431640625e-7F;

// 2^-22. An origin moved by this share of itself has moved at least by what rounding the move can take back.
LICHT_CONSTANT float kBvhOriginSlack = 2.384185791015625e-7F;

// 1 + 16u and 1 - 16u. Ize 2013, Robust BVH Ray Traversal, wants 1 + 2 gamma(3) on the far plane; gamma(7) allows for a device's division.
LICHT_CONSTANT float kBvhFarWider = 1.00000095367431640625F;
LICHT_CONSTANT float kBvhFarNarrower = 0.99999904632568359375F;

LICHT_SHARED_END
#endif
