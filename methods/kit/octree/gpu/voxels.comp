// Reduces the particles of each voxel, in sorted order, which is that of the store.
layout(local_size_x = 256) in;
layout(std430, binding = 0) restrict readonly buffer Starts { uint starts[]; };
layout(std430, binding = 1) restrict writeonly buffer Voxels { uvec4 voxels[]; };
layout(std140, binding = 2) uniform VoxelTally { uint voxelCount; };

layout(std430, binding = 2) restrict readonly buffer Indices { uint indices[]; };
layout(std430, binding = 3) restrict readonly buffer Places { uvec2 places[]; };

void main() {
    uint v = gl_GlobalInvocationID.x;
    if (v >= voxelCount) return;
    uint k = starts[v], end = v + 1u < voxelCount ? starts[v + 1u] : particlesInside();
    uvec2 place = places[indices[k]];
    uint rise = riseOf(place);
    Sum sum = nobody;
    while (k < end) {
        uint level = 0u, bits = 0u;  // of the largest block that begins here and lies inside; 0: one particle
        while (level < blockLevels && (k >> bits & 15u) == 0u && k + (16u << bits) <= end) {
            ++level;
            bits += blockBits;
        }
        if (level == 0u)
            sum = added(sum, sumOf(indices[k], rise));
        else
            sum = added(sum, sumIn(blocks[blockIndex(level - 1u, k >> bits)]));
        k += 1u << bits;
    }
    if (!accumulates()) sum.mass = massOf(sum.winner, rise);
    voxels[v] = uvec4(place, sum.winner, floatBitsToUint(float(sum.mass)));
}
