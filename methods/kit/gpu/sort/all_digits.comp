// Counts the values of the digits of all passes over all keys, and clears the states of scatter.comp for these passes.
layout(std430, binding = 0) restrict readonly buffer Plan {
    uint count, tiles;
};
layout(std430, binding = 1) restrict readonly buffer Keys {
    uint keys[];
};
layout(std430, binding = 5) restrict buffer Totals {
    uint totals[];  // a row of values for each place; initially 0
};
layout(std430, binding = 6) restrict writeonly buffer States {
    uint states[];  // a table of tiles and values for each place
};

uniform int passes;

shared uint counts[places * values];

void main() {
    uint own = ownThread();
    for (uint at = 0u; at < uint(passes); ++at) counts[at * values + own] = 0u;
    barrier();
    for (uint tile = gl_WorkGroupID.x; tile < tiles; tile += gl_NumWorkGroups.x) {
        for (uint at = 0u; at < uint(passes); ++at) states[(at * tiles + tile) * values + own] = 0u;
        for (uint item = 0u; item < KEYS_PER_THREAD; ++item) {
            uint index = tile * tileKeys + item * threads + own;
            if (index >= count) continue;
            uint key = keys[index];
            for (uint at = 0u; at < uint(passes); ++at) atomicAdd(counts[at * values + digitAt(key, at)], 1u);
        }
    }
    barrier();
    for (uint at = 0u; at < uint(passes); ++at) {
        uint found = counts[at * values + own];
        if (found > 0u) atomicAdd(totals[at * values + own], found);
    }
}
