// The rounding bounds that make the traversal lose no hit, for builder, CPU traversal and shader alike.
#ifndef LICHT_SHARED_BVH_NUMERICS_H
#define LICHT_SHARED_BVH_NUMERICS_H
#include "seam.h"

LICHT_SHARED_BEGIN

// Vertices and ray origins beyond this are left out: (2 * 1.8e18)^2 * 6, the largest edge sum and box area, is still finite.
LICHT_CONSTANT float kBvhLargestCoordinate = 1.8e18F;

// 2^-80. A direction whose largest component is shorter counts as zero. Longer ones are first scaled by a power of two, exactly, so that their
// largest component is in [1, 2) and nothing below can overflow.
LICHT_CONSTANT float kBvhShortestDirection = 8.271806125530277e-25F;

// 2^-40. Direction components below this share of the largest are lengthened to it for the box test alone, so that no zero meets an
// infinity. The ray moves by less than 2^-39 of its length, which kBvhShearSlack holds many times over.
LICHT_CONSTANT float kBvhFlattestDirection = 9.094947017729282e-13F;

// 2^-20 = 16 u (u = 2^-24). A sheared vertex is off by at most 2u |x| + 8u |z| (one subtraction; shear, product, difference; the shear's
// division may be off by 2.5 ulp on a device), so the boxes are widened sideways by twice that (Woop, Benthin, Wald 2013, section 4).
LICHT_CONSTANT float kBvhShearSlack = 9.5367431640625e-7F;

// 2^-18 = 64u, of P (P + 2 Z) / |determinant| times the spread of the vertices' distances. P: how far the vertices pass the ray; Z: the largest
// distance. A sheared vertex is off by 5u M, with M <= P + 2 Z its largest coordinate; an edge function by 4 * 5u M P + 3u P^2 <= 23u M P; of the
// barycentrics, which share the determinant, each is off by at most two edge functions' error over it; and the distance by their error times half the
// spread (about its middle) for each of the three: 3 * 2 * 23u / 2 = 69u, less what cannot be largest at once. A hit nearer than that may lie behind the
// origin: needles that a ray leaves would be met again (PBRT 4, section 6.8.7, is more cautious: it takes distances for their spread).
LICHT_CONSTANT float kBvhDistanceSlack = 3.814697265625e-6F;

// 2^-22. An origin moved by this share of itself has moved at least by what rounding the move can take back.
LICHT_CONSTANT float kBvhOriginSlack = 2.384185791015625e-7F;

// 2^-21 = 8u, of |B| + 255 |A|: a plane is met at t = q A + B with A = 2^e / d (exact) and B = (origin of the grid - origin) / d (3u with a division
// that is off by 2.5 ulp, one more in it); product and sum add 2u. The triangle's own entry into its box (testTriangle) is off by at most 4u of the
// same, so a box that is widened by this is never met later than a triangle inside it (Ize 2013, Robust BVH Ray Traversal, for the idea).
LICHT_CONSTANT float kBvhPlaneSlack = 4.76837158203125e-7F;

// 2^-19 = 32 u, times an instance's condition (the product of the norms of its matrix and the inverse) and the ray's reach: how far the ray in object
// space can stray, seen from the world. Origin: 1 u from the difference to the pivot, 3 u from the products, 1 u from the rounded matrix; direction
// the same without the difference: 9 u. The object's own test may accept 10 u beside a triangle, and its t may be off by 8 u.
LICHT_CONSTANT float kInstanceSlack = 1.9073486328125e-6F;

LICHT_SHARED_END
#endif
