// A work group of 256 threads, and inclusive sums over its threads.
//
// SUBGROUPS: the device has subgroups of 32 threads; sums and ranks then exchange values within a subgroup. NVIDIA's
// compiler keeps arrays in registers only if it unrolls the loops over them.
#ifdef SUBGROUPS
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#endif
#pragma optionNV(unroll all)
layout(local_size_x = 256) in;

const uint threads = 256u, warpThreads = 32u, warps = 8u;

#ifdef SUBGROUPS
shared uvec2 sumsOfWarps[warps];

uint ownThread() {
    return gl_SubgroupID * warpThreads + gl_SubgroupInvocationID;
}

/// The sums over this thread and those before it. All threads must call it; a second call needs a barrier in between.
uvec2 inclusiveSums(uvec2 value) {
    uvec2 sums = subgroupInclusiveAdd(value);
    if (gl_SubgroupInvocationID == warpThreads - 1u) sumsOfWarps[gl_SubgroupID] = sums;
    barrier();
    for (uint warp = 0u; warp < warps; ++warp)
        if (warp < gl_SubgroupID) sums += sumsOfWarps[warp];
    return sums;
}
#else
shared uvec2 sumsOfThreads[threads];

uint ownThread() {
    return gl_LocalInvocationIndex;
}

uvec2 inclusiveSums(uvec2 value) {
    uint own = ownThread();
    uvec2 sums = value;
    sumsOfThreads[own] = sums;
    barrier();
    for (uint distance = 1u; distance < threads; distance *= 2u) {
        if (own >= distance) sums += sumsOfThreads[own - distance];
        barrier();
        sumsOfThreads[own] = sums;
        barrier();
    }
    return sums;
}
#endif
