// Running mean and sum of squared deviations that neither stall nor drift: Welford 1962 (Note on a Method for Calculating Corrected Sums of
// Squares and Products) with every accumulator an unevaluated sum of two floats (Dekker 1971, A Floating-Point Technique for Extending the
// Available Precision). `precise` keeps the compiler from simplifying the error terms to zero.
#ifndef LICHT_PURE_RUNNING_MEAN_GLSL
#define LICHT_PURE_RUNNING_MEAN_GLSL

struct TwoFloat4 {
    vec4 high;
    vec4 low;
};

TwoFloat4 addTo(TwoFloat4 a, vec4 b) {
    precise vec4 sum = a.high + b;
    precise vec4 b_part = sum - a.high;
    precise vec4 error = (a.high - (sum - b_part)) + (b - b_part);
    precise vec4 low = a.low + error;
    precise vec4 high = sum + low;
    precise vec4 rest = low - (high - sum);
    return TwoFloat4(high, rest);
}

struct RunningMean {
    TwoFloat4 mean;
    TwoFloat4 squares;  // sum of squared deviations from the mean
};

// The n-th value (n >= 1).
RunningMean addSample(RunningMean r, vec4 value, float n) {
    precise vec4 delta = (value - r.mean.high) - r.mean.low;
    r.mean = addTo(r.mean, delta / n);
    precise vec4 delta_after = (value - r.mean.high) - r.mean.low;
    r.squares = addTo(r.squares, delta * delta_after);
    return r;
}

#endif
