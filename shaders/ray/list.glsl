// Traces the rays of a list. Where lanes run in lockstep, those whose ray has ended would wait for the longest of their subgroup: there a subgroup owns a
// share of the list, and its lanes take the next ray of it as soon as theirs has ended (after Aila, Laine 2009, Understanding the Efficiency of Ray
// Traversal on GPUs). Elsewhere a thread traces one ray.
// The including shader has subgroup ballots, includes ray/traversal.glsl before and defines
//     struct RayTask                                         a ray of the list, and what it is traced for
//     RayTask takeTask(uint i)
//     RayQuery queryOf(RayTask task)
//     bool passesThrough(inout RayTask task, TraceHit found) notes what it hit; true: it goes on behind that, by its new query
//     void endTask(bool ends, RayTask task)                  called by all threads of a subgroup together
#ifndef LICHT_RAY_LIST_GLSL
#define LICHT_RAY_LIST_GLSL

// Of eight lanes, when new rays are set up: sooner, setting up is paid for too often; later, too many lanes wait (tests/bench/MEASURED.md, rays).
const uint kIdleOfEight = 3u;

// Threads beyond the list are allowed. Returns how many traversals were truncated.
uint traceOneEach(uint count) {
    bool have = gl_GlobalInvocationID.x < count;
    bool truncated = false;
    RayTask task;
    if (have) {
        task = takeTask(gl_GlobalInvocationID.x);
        while (true) {
            TraceResult found = traceRay(queryOf(task));
            truncated = truncated || found.truncated;
            if (!passesThrough(task, found.hit)) break;
        }
    }
    endTask(have && !truncated, task);
    return truncated ? 1u : 0u;
}

uint traceShare(uint count) {
    uint share = gl_SubgroupSize * kRaysPerThread;
    uint next = (gl_WorkGroupID.x * gl_NumSubgroups + gl_SubgroupID) * share;
    uint end = min(next + share, count);
    uint enough = gl_SubgroupSize - max(gl_SubgroupSize * kIdleOfEight / 8u, 1u);  // that go on, while there are rays to take
    vec3 scene_lower, scene_upper;
    treeBounds(0u, scene_lower, scene_upper);
    RayTask task;
    Traversal s = startTraversal(kNoRayQuery, scene_lower, scene_upper);  // has ended
    bool have = false;  // a ray that has not ended for its task yet
    bool any_have = true;
    while (any_have) {
        bool ended = have && !goesOn(s);
        bool again = ended && passesThrough(task, hitOf(s));
        endTask(ended && !again, task);
        bool takes = (!have || ended) && !again;
        uvec4 takers = subgroupBallot(takes);
        uint i = next + subgroupBallotExclusiveBitCount(takers);
        next += subgroupBallotBitCount(takers);
        takes = takes && i < end;
        have = takes || again || (have && !ended);
        if (takes) task = takeTask(i);
        if (takes || again) s = startTraversal(queryOf(task), scene_lower, scene_upper);
        any_have = subgroupBallotBitCount(subgroupBallot(have)) > 0u;
        uint most_left = next < end ? enough : 0u;
        bool go = any_have;
        while (go) {
            stepTraversal(queryOf(task), s);
            go = subgroupBallotBitCount(subgroupBallot(goesOn(s))) > most_left;
        }
    }
    return (have ? 1u : 0u) + (subgroupElect() && next < end ? end - next : 0u);
}

uint traceList(uint count) { return kRefilled ? traceShare(count) : traceOneEach(count); }

#endif
