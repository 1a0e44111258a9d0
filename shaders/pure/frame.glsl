// Local frames: +Z is the normal.
#ifndef LICHT_PURE_FRAME_GLSL
#define LICHT_PURE_FRAME_GLSL

struct Frame {
    vec3 tangent;
    vec3 bitangent;
    vec3 normal;
};

// Duff et al. 2017, Building an Orthonormal Basis, Revisited (JCGT 6(1)).
Frame frameFromNormal(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return Frame(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// A unit vector in 32 bits: the octahedron unfolded. Meyer et al. 2010, On Floating-Point Normal Vectors.
uint packOctahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return packSnorm2x16(n.z >= 0.0 ? p : folded);
}

vec3 unpackOctahedral(uint bits) {
    vec2 p = unpackSnorm2x16(bits);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float t = max(-n.z, 0.0);
    n.xy -= t * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    return normalize(n);
}

vec3 localFromWorld(Frame f, vec3 w) { return vec3(dot(w, f.tangent), dot(w, f.bitangent), dot(w, f.normal)); }
vec3 worldFromLocal(Frame f, vec3 l) { return l.x * f.tangent + l.y * f.bitangent + l.z * f.normal; }

#endif
