// The angle of a point of the upper half plane. The built-in function may be off by 4096 ulp, which a density would keep as bias.
#ifndef LICHT_PURE_ARCTANGENT_GLSL
#define LICHT_PURE_ARCTANGENT_GLSL

// In [0, pi], for y >= 0, within 4 ulp; 0 at the origin. Odd minimax polynomial for the relative error on [0, 1] (0.3 half ulps; the rest is
// rounding), found by Lawson's iteration: Lawson 1961, Contributions to the Theory of Linear Least Maximum Approximation.
float arctangent(float y, float x) {
    float longer = max(y, abs(x));
    float t = longer > 0.0 ? min(y, abs(x)) / longer : 0.0;
    float t2 = t * t;
    float p = 0.0432118646 + t2 * (-0.0163679304 + t2 * 0.00292069287);
    p = -0.142110553 + t2 * (0.106660048 + t2 * (-0.0755221459 + t2 * p));
    p = t + t * (t2 * (-0.333331527 + t2 * (0.199937728 + t2 * p)));
    float angle = y > abs(x) ? 1.57079632679489662 - p : p;
    return x < 0.0 ? 3.14159265358979324 - angle : angle;
}

#endif
