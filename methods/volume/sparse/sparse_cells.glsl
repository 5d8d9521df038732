// Samples the densities of a sparse volume, for grid_optics.glsl and grid_march.frag. Source: Museth2021.
//
// Cells whose samples may see density are active; all other cells are 0 (nano_tree.h). Lengths are in cells;
// positions are relative to the minimum corner of the box.
#define SPARSE
uniform vec3 cells;       // of the box
uniform ivec3 firstCell;  // of the box, in the trees
#ifdef FIRE
uniform int reactionTree;  // its address
#endif

pnanovdb_buf_t trees;
// Nodes of the last sample, since the next one is nearby.
pnanovdb_readaccessor_t densityNodes;
bool isOpen = false;
#ifdef FIRE
pnanovdb_readaccessor_t reactionNodes;
#endif
int emptyEdge = 0;  // edge of the empty node that contained the last sample; 0: there was none
ivec3 emptyCell;

void openTree(out pnanovdb_readaccessor_t nodes, uint address) {
    pnanovdb_grid_handle_t grid = { { address } };
    pnanovdb_readaccessor_init(nodes, pnanovdb_tree_get_root(trees, pnanovdb_grid_get_tree(trees, grid)));
}

// Interpolates linearly between the two values from an address on.
float alongZ(uint address, float share) {
    return mix(uintBitsToFloat(pnanovdb_buf_data[address >> 2]), uintBitsToFloat(pnanovdb_buf_data[(address >> 2) + 1u]),
               share);
}

float valueAt(inout pnanovdb_readaccessor_t nodes, ivec3 cell) {
    uint level;
    uint address = pnanovdb_readaccessor_get_value_address_and_level(PNANOVDB_GRID_TYPE_FLOAT, trees, nodes, cell,
                                                                     level).byte_offset;
    return uintBitsToFloat(pnanovdb_buf_data[address >> 2]);
}

// Interpolates linearly between the eight neighbours.
float sampledSparse(inout pnanovdb_readaccessor_t nodes, ivec3 cell, vec3 share) {
    if (all(lessThan(cell & 7, ivec3(7)))) {
        uint level;
        uint address = pnanovdb_readaccessor_get_value_address_and_level(PNANOVDB_GRID_TYPE_FLOAT, trees, nodes,
                                                                         cell, level).byte_offset;
        if (level > 0u) return 0.0;
        const uint y = 8u * 4u, x = 64u * 4u;
        return mix(mix(alongZ(address, share.z), alongZ(address + y, share.z), share.y),
                   mix(alongZ(address + x, share.z), alongZ(address + x + y, share.z), share.y), share.x);
    }
    vec4 near, far;
    for (int i = 0; i < 4; ++i) {
        near[i] = valueAt(nodes, cell + ivec3(0, i >> 1, i & 1));
        far[i] = valueAt(nodes, cell + ivec3(1, i >> 1, i & 1));
    }
    vec4 between = mix(near, far, share.x);
    vec2 column = mix(between.xy, between.zw, share.y);
    return mix(column.x, column.y, share.z);
}

void neighbours(vec3 at, out ivec3 cell, out vec3 share) {
    vec3 place = clamp(at - 0.5, vec3(0), cells - 1.0), low = floor(place);
    cell = ivec3(low) + firstCell;
    share = place - low;
}

float densityAt(vec3 at) {
    ivec3 cell;
    vec3 share;
    neighbours(at, cell, share);
    if (!isOpen) openTree(densityNodes, 0u);
#ifdef FIRE
    if (!isOpen) openTree(reactionNodes, uint(reactionTree));
#endif
    isOpen = true;
    emptyEdge = 0;
    if (pnanovdb_readaccessor_is_active(PNANOVDB_GRID_TYPE_FLOAT, trees, densityNodes, cell))
        return sampledSparse(densityNodes, cell, share);
    int edge = int(pnanovdb_readaccessor_get_dim(PNANOVDB_GRID_TYPE_FLOAT, trees, densityNodes, cell));
    emptyEdge = edge > 1 ? edge : 0;  // 1: the sample is in a leaf
    emptyCell = cell & ~(edge - 1);
    return 0.0;
}

#ifdef FIRE
float reactionAt(vec3 at) {
    ivec3 cell;
    vec3 share;
    neighbours(at, cell, share);
    return sampledSparse(reactionNodes, cell, share);
}
#endif

// Number of steps from `start` on whose centres are in the empty node that contained the last sample.
int stepsClear(vec3 start, vec3 ray, float stepLength) {
    if (emptyEdge == 0) return 0;
    vec3 low = vec3(emptyCell - firstCell) + 0.5;
    vec3 leaves = (low + mix(vec3(0), vec3(emptyEdge), greaterThan(ray, vec3(0))) - start) / ray;
    float ahead = min(min(leaves.x, leaves.y), leaves.z);
    return int(clamp(floor(ahead / stepLength - 0.5), 0.0, 1e6));
}
