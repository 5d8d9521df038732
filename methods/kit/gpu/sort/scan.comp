// Inclusive sums of a tile, added to the sum of the earlier tiles. COMPACT: the sums count the flags that are set, which
// gives each flagged element its place in the output.
layout(std430, binding = 0) restrict readonly buffer Plan {
    uint count, tiles;
};
layout(std430, binding = 1) readonly buffer Elements {
    uint elements[];  // flags if COMPACT
};
layout(std430, binding = 6) restrict readonly buffer Before {
    uint before[];  // sum of the earlier tiles
};
#ifdef COMPACT
layout(std430, binding = 2) restrict readonly buffer Values {
    uint values[];
};
layout(std430, binding = 3) restrict writeonly buffer Kept {
    uint kept[];
};
#else
layout(std430, binding = 3) writeonly buffer Sums {
    uint sums[];  // may be the elements
};
#endif

const uint perThread = TILE_ELEMENTS / threads;
shared uint tileWords[TILE_ELEMENTS + TILE_ELEMENTS / 32u];

/// Spreads over the banks of shared memory: threads access words `perThread` apart.
uint wordAt(uint at) {
    return at + at / 32u;
}

void main() {
    uint own = ownThread(), tile = gl_WorkGroupID.x, first = tile * TILE_ELEMENTS;
    for (uint at = own; at < TILE_ELEMENTS; at += threads)
        tileWords[wordAt(at)] = first + at < count ? LOADED(elements[first + at]) : 0u;
    barrier();
    uint sumOfThread = 0u;
    for (uint item = 0u; item < perThread; ++item) {
        uint word = wordAt(own * perThread + item);
        sumOfThread += tileWords[word];
        tileWords[word] = sumOfThread;
    }
    uint sumBefore = before[tile] + inclusiveSums(uvec2(sumOfThread, 0u)).x - sumOfThread;
    for (uint item = 0u; item < perThread; ++item) tileWords[wordAt(own * perThread + item)] += sumBefore;
    barrier();
    for (uint at = own; at < TILE_ELEMENTS; at += threads) {
        uint index = first + at;
        if (index >= count) break;
#ifdef COMPACT
        if (elements[index] != 0u) kept[tileWords[wordAt(at)] - 1u] = values[index];
#else
        sums[index] = tileWords[wordAt(at)];
#endif
    }
}
