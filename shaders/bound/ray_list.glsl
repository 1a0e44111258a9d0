// Traces the rays of a list. Where lanes run in lockstep, those whose ray has ended would wait for the longest of their subgroup: there a subgroup owns a
// share of the list, and its lanes take the next ray of it as soon as theirs has ended (after Aila, Laine 2009, Understanding the Efficiency of Ray
// Traversal on GPUs). Elsewhere a thread traces one ray.
// The including shader has subgroup ballots, includes bound/traversal.glsl before and defines
//     void takeRay(uint i, out vec3 origin, out vec3 direction, out float t_min, out float t_max)
//     bool passesThrough(TraceHit found)           whether the ray taken last goes on behind what it hit
//     void giveHit(bool gives, TraceHit found)     for the ray taken last; called by all threads of a subgroup together
#ifndef LICHT_BOUND_RAY_LIST_GLSL
#define LICHT_BOUND_RAY_LIST_GLSL

// Of eight lanes, when new rays are set up: sooner, setting up is paid for too often; later, too many lanes wait (tests/bench/MEASURED.md, rays).
const uint kIdleOfEight = 3u;

// Threads beyond the list are allowed. Returns how many rays were lost to a loop that was cut.
uint traceOneEach(uint count, bool any_hit) {
    bool have = gl_GlobalInvocationID.x < count;
    TraceHit found = kNoTraceHit;
    if (have) {
        vec3 origin, direction;
        float t_min, t_max;
        takeRay(gl_GlobalInvocationID.x, origin, direction, t_min, t_max);
        while (true) {
            found = traceRay(origin, direction, t_min, t_max, any_hit);
            if (!passesThrough(found)) break;
            t_min = found.t;
        }
    }
    giveHit(have && !bvh_walk_cut, found);
    return bvh_walk_cut ? 1u : 0u;
}

uint traceShare(uint count, bool any_hit) {
    uint share = gl_SubgroupSize * kRaysPerThread;
    uint next = (gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID) * share;
    uint end = min(next + share, count);
    uint enough = gl_SubgroupSize - max(gl_SubgroupSize * kIdleOfEight / 8u, 1u);  // that walk, while there are rays to take
    vec3 scene_lower, scene_upper;
    treeBounds(0u, scene_lower, scene_upper);
    vec3 origin = vec3(0.0), direction = vec3(0.0);
    float t_min = 0.0, t_max = 0.0;
    Walk w;
    startWalk(w, origin, direction, t_min, t_max, scene_lower, scene_upper);  // has no direction, so it has ended
    bool have = false;  // a ray whose hit is not given yet
    bool any_have = true;
    while (any_have) {
        bool ended = have && !walks(w);
        TraceHit found = hitOfWalk(w);
        bool again = ended && passesThrough(found);
        giveHit(ended && !again, found);
        bool takes = (!have || ended) && !again;
        uvec4 takers = subgroupBallot(takes);
        uint i = next + subgroupBallotExclusiveBitCount(takers);
        next += subgroupBallotBitCount(takers);
        takes = takes && i < end;
        have = takes || again || (have && !ended);
        if (takes) takeRay(i, origin, direction, t_min, t_max);
        if (again) t_min = found.t;
        if (takes || again) startWalk(w, origin, direction, t_min, t_max, scene_lower, scene_upper);
        any_have = subgroupBallotBitCount(subgroupBallot(have)) > 0u;
        uint most_left = next < end ? enough : 0u;
        bool go = any_have;
        while (go) {
            walkOn(w, any_hit);
            go = subgroupBallotBitCount(subgroupBallot(walks(w))) > most_left;
        }
    }
    return (have ? 1u : 0u) + (subgroupElect() && next < end ? end - next : 0u);
}

uint traceList(uint count, bool any_hit) { return kRefilled ? traceShare(count, any_hit) : traceOneEach(count, any_hit); }

#endif
