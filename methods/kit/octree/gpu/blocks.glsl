// Sums of blocks of sorted particles that share one voxel, in three levels: of 16, 256 and 4096 particles. Blocks with
// several voxels have no sum.
layout(std430, binding = 7) restrict buffer Blocks { uvec4 blocks[]; };
uniform int capacity;  // particles that there is room for

const uint blockBits = 4u, blockLevels = 3u;

/// The index of a level's block, by its number.
uint blockIndex(uint level, uint number) {
    for (uint below = 0u; below < level; ++below) number += (uint(capacity) >> blockBits * (below + 1u)) + 1u;
    return number;
}
