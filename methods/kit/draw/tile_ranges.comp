// The range of each tile in the pairs that are sorted by tile. Ranges of tiles without pairs stay 0.
layout(local_size_x = 256) in;
layout(std430, binding = 0) restrict readonly buffer Pairs {
    uint pairs;
};
layout(std430, binding = 1) restrict readonly buffer Tiles {
    uint tiles[];
};
layout(std430, binding = 2) restrict writeonly buffer Ranges {
    uint ranges[];  // begin and end of each tile
};

void main() {
    for (uint at = gl_GlobalInvocationID.x; at < pairs; at += 256u * gl_NumWorkGroups.x) {
        uint tile = tiles[at];
        if (at == 0u || tiles[at - 1u] != tile) ranges[2u * tile] = at;
        if (at == pairs - 1u || tiles[at + 1u] != tile) ranges[2u * tile + 1u] = at + 1u;
    }
}
