// Triangles, rectangles and cones as solid angles: their size, and directions spread evenly over them. A sample's density is one over the size;
// both come from the same intermediate values, so the compiler shares them. Differences of nearly equal numbers are written as sums wherever
// a closed form exists, so that small and far shapes keep their digits.
#ifndef LICHT_PURE_SPHERICAL_GLSL
#define LICHT_PURE_SPHERICAL_GLSL

#include "pure/arctangent.glsl"
#include "pure/sampling.glsl"

// Outside these the shape is sampled by area. Below, unit directions in fp32 (steps of 6e-8) no longer resolve the shape, and distance and
// cosine hardly vary over it; above, the point all but touches the plane, where fp32 decides on which side it is.
const float kSmallestSolidAngle = 1e-6;
const float kLargestSolidAngle = 6.2;

// Keeps the reciprocal of a square finite; squares of lengths that fp32 can hold as normal numbers are larger.
const float kLeastSquare = 1e-37;

struct SphericalTriangle {
    vec3 a, b, c;         // unit
    float volume;         // |det(a, b, c)|
    float one_ab, bc_ca;  // 1 + ab and bc + ca, of the cosines of the sides
    float half_angle;     // half the solid angle
};

SphericalTriangle sphericalTriangle(vec3 a, vec3 b, vec3 c) {
    SphericalTriangle t;
    vec3 inverse = inversesqrt(max(vec3(dot(a, a), dot(b, b), dot(c, c)), kLeastSquare));
    t.a = a * inverse.x;
    t.b = b * inverse.y;
    t.c = c * inverse.z;
    // By the edges, which lose nothing: three long and nearly parallel vectors would.
    t.volume = abs(dot(t.a, cross(b - a, c - a))) * inverse.y * inverse.z;
    vec3 sum = t.a + t.b;  // keeps digits when a and b are nearly opposite
    t.one_ab = 0.5 * dot(sum, sum);
    t.bc_ca = dot(t.c, sum);
    // Van Oosterom and Strackee 1983, The Solid Angle of a Plane Triangle. In the triangle's plane it sends nothing, inside it too.
    t.half_angle = t.volume > 0.0 ? arctangent(t.volume, t.one_ab + t.bc_ca) : 0.0;
    return t;
}

// Of the triangle with these vertices as seen from the origin, of either winding. 0 if it has no area or lies edge on.
float solidAngleTriangle(vec3 a, vec3 b, vec3 c) { return 2.0 * sphericalTriangle(a, b, c).half_angle; }

// A unit direction to the triangle, uniform by solid angle. Arvo 1995, Stratified Sampling of Spherical Triangles: x on the side a c cuts off
// the share u.x, then the arc b x is followed. x without inverse cosines by a reflection: Peters 2021, BRDF Importance Sampling for Polygonal
// Lights; here tan(area / 2) = det(a, b, x) / (1 + ab + bx + xa) is solved for the bisector of a and x, which no small triangle makes cancel.
vec3 sampleTriangleSolidAngle(vec3 a, vec3 b, vec3 c, vec2 u) {
    SphericalTriangle t = sphericalTriangle(a, b, c);
    vec2 e = unitCircle(u.x * t.half_angle * (0.5 * kInvPi));
    vec3 bisector = (t.volume * e.x - t.bc_ca * e.y) * t.a + t.one_ab * e.y * t.c;
    vec3 x = 2.0 * dot(t.a, bisector) / max(dot(bisector, bisector), kLeastSquare) * bisector - t.a;
    // Along the arc 1 - cos is uniform, which is half the chord's square: no cancellation for short arcs.
    vec3 chord = x - t.b;
    float whole = 0.5 * dot(chord, chord);
    float part = u.y * whole;
    vec3 tangent = chord + whole * t.b;
    vec3 w = (1.0 - part) * t.b + sqrt(part * (2.0 - part) / max(dot(tangent, tangent), kLeastSquare)) * tangent;
    return w * (1.5 - 0.5 * dot(w, w));  // one step of Newton's towards unit length, for arcs of nearly pi
}

// In a frame along the edges and away from the plane, in units in which nothing exceeds one.
struct SphericalRectangle {
    vec2 x, y;          // of the first and the second side
    float z;            // distance of the plane, above 0
    vec2 r;             // distances of the two sides along x from the origin
    vec2 near, far;     // distances of the corners at x.x and at x.y, by y
    float half_angle;   // half the solid angle
};

SphericalRectangle sphericalRectangle(vec3 corner, vec3 edge_u, vec3 edge_v) {
    // Where less of the size of things remains between point and plane, their positions' roundings have decided it.
    const float kLeastDistance = 1e-8;
    SphericalRectangle s;
    vec3 square = max(vec3(dot(edge_u, edge_u), dot(edge_v, edge_v), dot(corner, corner)), kLeastSquare);
    vec3 inverse = inversesqrt(square);
    vec3 unit_u = edge_u * inverse.x, unit_v = edge_v * inverse.y;
    vec3 sizes = square * inverse;
    float scale = 1.0 / (sizes.x + sizes.y + sizes.z);
    vec2 size = sizes.xy * scale;
    s.x = vec2(dot(corner, unit_u) * scale);
    s.y = vec2(dot(corner, unit_v) * scale);
    s.x.y += size.x;
    s.y.y += size.y;
    float z = abs(dot(corner, cross(unit_u, unit_v))) * scale;
    s.z = max(z, kLeastDistance);
    vec2 x2 = s.x * s.x, r2 = s.y * s.y + s.z * s.z;
    s.r = sqrt(r2);
    s.near = sqrt(r2 + x2.x);
    s.far = sqrt(r2 + x2.y);
    // Two triangles (Van Oosterom and Strackee 1983), of the same volume, their half angles added as the product of complex numbers.
    float xx = s.x.x * s.x.y, yy = s.y.x * s.y.y;
    float volume = z * size.x * size.y;
    float diagonal = xx + yy + s.z * s.z, both = s.near.x * s.far.y;
    float lower = s.far.x * (both + diagonal) + (xx + r2.x) * s.far.y + (yy + s.z * s.z + x2.y) * s.near.x;
    float upper = s.near.y * (both + diagonal) + (xx + r2.y) * s.near.x + (yy + s.z * s.z + x2.x) * s.far.y;
    s.half_angle = volume > 0.0 ? arctangent(volume * (lower + upper), lower * upper - volume * volume) : 0.0;
    return s;
}

// Of the rectangle as seen from the origin; 0 if it has no area or lies edge on. The edges are orthogonal.
float solidAngleRectangle(vec3 corner, vec3 edge_u, vec3 edge_v) { return 2.0 * sphericalRectangle(corner, edge_u, edge_v).half_angle; }

// The vector to a point of the rectangle, uniform by solid angle. The map of Urena, Fajardo and King 2013, An Area-Preserving Parametrization
// for Spherical Rectangles: u.x is the share of the solid angle on the lesser side of the plane x = const, u.y the height along its arc.
// With t(x) = tan(half the solid angle between 0 and x), t = d x (r0 + r1) / (R0 r1 + R1 r0) where d = t(infinity) and R_i^2 = x^2 + r_i^2,
// which inverts to x = 2 t r0 r1 / ((r0 + r1) sqrt((d - t) (d + t) (1 - m^2 t^2))). All sums of angles are taken on these tangents.
vec3 sampleRectangleSolidAngle(vec3 corner, vec3 edge_u, vec3 edge_v, vec2 u) {
    SphericalRectangle s = sphericalRectangle(corner, edge_u, edge_v);
    // d and m are the tangents of half the difference and half the sum of the two sides' angles atan(y / z).
    float yy = s.y.x * s.y.y, rr = s.r.x * s.r.y;
    float p = rr + abs(yy);
    float same = s.z / (p + s.z * s.z);
    float opposite = p / (s.z * (p + dot(s.y, s.y) + s.z * s.z));
    bool astride = yy < 0.0;
    float d = (s.y.y - s.y.x) * (astride ? opposite : same);
    float m = (s.y.y + s.y.x) * (astride ? same : opposite);
    // d - t and d + t at the first side; the smaller of the two by a sum.
    float a = abs(s.x.x);
    vec2 reach = s.near + a;
    float weight = s.near.x * s.r.y + s.near.y * s.r.x;
    float k = d / weight;
    float first = k * s.x.x * (s.r.x + s.r.y);
    float wide = k * (s.r.y * reach.x + s.r.x * reach.y);
    float narrow = k * rr * (s.r.x * reach.y + s.r.y * reach.x) / (reach.x * reach.y);
    bool right = s.x.x >= 0.0;
    // t = n / q behind the share u.x of the solid angle.
    vec2 e = unitCircle(u.x * s.half_angle * (0.5 * kInvPi));
    float n = first * e.x + e.y, q = e.x - first * e.y;
    float below = (right ? narrow : wide) * e.x - (1.0 + d * first) * e.y;
    float above = (right ? wide : narrow) * e.x + (1.0 - d * first) * e.y;
    float square = below * above * (q - m * n) * (q + m * n);
    float x = 2.0 * n * q * rr / (s.r.x + s.r.y) * inversesqrt(max(square, kLeastSquare));
    x = clamp(x, s.x.x, s.x.y);
    // The sine of the elevation over the plane y = 0 is uniform; 1 + sine and 1 - sine are carried along, both as sums.
    float l2 = x * x + s.z * s.z;
    vec2 tall = abs(s.y), l = sqrt(l2 + tall * tall);
    vec2 large = (l + tall) / l, small = l2 / (l * (l + tall));
    vec2 plus = vec2(s.y.x >= 0.0 ? large.x : small.x, s.y.y >= 0.0 ? large.y : small.y);
    vec2 minus = vec2(s.y.x >= 0.0 ? small.x : large.x, s.y.y >= 0.0 ? small.y : large.y);
    vec2 sine = vec2((1.0 - u.y) * plus.x + u.y * plus.y, (1.0 - u.y) * minus.x + u.y * minus.y);
    float y = 0.5 * (sine.x - sine.y) * sqrt(l2 / (sine.x * sine.y));
    y = clamp(y, s.y.x, s.y.y);
    vec2 size = vec2(s.x.y - s.x.x, s.y.y - s.y.x);
    return corner + (x - s.x.x) / max(size.x, kLeastSquare) * edge_u + (y - s.y.x) / max(size.y, kLeastSquare) * edge_v;
}

// 1 - cos of a cone's half angle, at most pi / 2, from the square of its sine: no cancellation.
float coneHeight(float sin2_half_angle) { return sin2_half_angle / (1.0 + sqrt(max(1.0 - sin2_half_angle, 0.0))); }

float solidAngleCone(float sin2_half_angle) { return 2.0 * kPi * coneHeight(sin2_half_angle); }

// A unit direction of the cone around +Z, uniform by solid angle.
vec3 sampleCone(float sin2_half_angle, vec2 u) {
    float height = u.x * coneHeight(sin2_half_angle);
    return vec3(sqrt(height * (2.0 - height)) * unitCircle(u.y), 1.0 - height);
}

// Whether a unit direction is in the cone around `axis`. The chord between them squared is 2 - 2 cos; in a narrow cone the difference is exact, and
// what a length is off by, 1e-7, adds only its square. The components' own rounding blurs the rim by as much, inwards and outwards alike.
bool insideCone(vec3 axis, float sin2_half_angle, vec3 direction) {
    vec3 chord = direction - axis;
    return dot(chord, chord) < 2.0 * coneHeight(sin2_half_angle);
}

#endif
