// Shared by all passes of an octree on the GPU: the settings of the frame (MomentValues in gpu_octree.cpp), the state
// that its passes build up, and the cells of particles.
//
// A quotient that decides on a cell or a level is taken in double precision and then rounded, which rounds correctly:
// quotients of floats need not be exact on a GPU.
layout(std140, binding = 0) uniform Moment {
    dvec4 vehicle;  // position, m; w: edge of the smallest world, m
    dvec4 edges;    // of the finest cell; of the cell in whose steps the world moves
    ivec4 tree;     // depth of the smallest world, levels, maximum depth; w: 1 if the maxima begin with this frame
    ivec4 rules;    // policy, level rule, 1 if opacity is by age
    vec4 scales;    // cells per metre; finest edge, m; edgesOfRadius (cell_kernel.h); opacity at birth
    ivec4 drawn;    // 1 for cubes
    vec4 shown;     // edge of a voxel per radius of its circle
};

const int policyMax = 0, policyAccumulate = 2, ruleAge = 0;

struct State {
    dvec4 origin;          // minimum corner of the world, m; w: its edge
    ivec4 first;           // number of its first finest cell along each axis; w: its depth
    uvec4 counts;          // particles outside; positions that are not numbers; particles; those with a second key
    uvec4 secondGroups;    // work groups of 256 for second keys
    uvec4 blockGroups[3];  // the same for blocks of 16, 256 and 4096 particles
    uvec4 maxima;          // of counts.x, of voxels, of depths; sum of counts.y
};
#ifdef CHANGES_STATE
layout(std430, binding = 0) buffer StateBuffer {
    State state;
};
#else
layout(std140, binding = 1) uniform StateBuffer {
    State state;
};
#endif

const uint nowhere = 0xffffffffu;
/// Up to this depth, a cell's number in pre-order fits one key.
const int oneKeyDepth = 10;

bool hasOneKey() {
    return state.first.w <= oneKeyDepth;
}
/// Particles inside the world, which come first in sorted order.
uint particlesInside() {
    return state.counts.z - state.counts.x;
}

float quotient(float a, float b) {
    precise double exact = double(a) / double(b);
    return float(exact);
}

/// Moves bit k of a number below 2^8 to bit 3·k.
uint spreadByte(uint x) {
    x = (x | x << 8) & 0x0000f00fu;
    x = (x | x << 4) & 0x000c30c3u;
    return (x | x << 2) & 0x00249249u;
}
uint spreadCell(uvec3 cell) {
    return spreadByte(cell.x) << 2 | spreadByte(cell.y) << 1 | spreadByte(cell.z);
}

/// A voxel's place (CellEntry::place), low and high word: 36 bits Morton code of its first finest cell, 15 − rise.
uvec2 placeOf(uvec3 cell, uint rise) {
    uvec3 corner = cell >> rise << rise;
    uint low = spreadCell(corner & 15u), high = spreadCell(corner >> 4 & 255u);
    return uvec2(high << 16 | low << 4 | 15u - rise, high >> 16);
}
uint riseOf(uvec2 place) {
    return 15u - (place.x & 15u);
}
/// The number of a voxel's cell in pre-order among all cells of a tree of at most `oneKeyDepth` levels.
uint preOrder(uvec2 place) {
    uint code = place.y << 28 | place.x >> 4, number = code + uint(state.first.w) - riseOf(place);
    for (int shift = 3; shift < 3 * state.first.w; shift += 3) number += code >> shift;
    return number;
}

/// Moves bit 3·k of a number below 2^12 to bit k.
uint gatherBits(uint x) {
    x &= 0x249u;
    x = (x | x >> 2) & 0x0c3u;
    return (x | x >> 4) & 0x00fu;
}
/// The first finest cell of a place.
uvec3 cellOf(uvec2 place) {
    uvec3 cell = uvec3(0);
    uint twelveBits[3] =
        uint[3](place.x >> 4 & 0xfffu, place.x >> 16 & 0xfffu, (place.y << 4 | place.x >> 28) & 0xfffu);
    for (int four = 0; four < 3; ++four) {
        uint bits = twelveBits[four];
        cell |= uvec3(gatherBits(bits >> 2), gatherBits(bits >> 1), gatherBits(bits)) << uint(4 * four);
    }
    return cell;
}
