// Counts the values of the current digit in a tile of keys.
layout(std430, binding = 0) restrict readonly buffer Plan {
    uint count, tiles;
};
layout(std430, binding = 1) restrict readonly buffer Keys {
    uint keys[];
};
layout(std430, binding = 6) restrict writeonly buffer Rows {
    uint rows[];  // a row of tiles for each value
};

shared uint counts[values];

void main() {
    uint own = ownThread(), tile = gl_WorkGroupID.x;
    counts[own] = 0u;
    barrier();
    for (uint item = 0u; item < KEYS_PER_THREAD; ++item) {
        uint index = tile * tileKeys + item * threads + own;
        if (index < count) atomicAdd(counts[digitOf(keys[index])], 1u);
    }
    barrier();
    rows[own * tiles + tile] = counts[own];
}
