// The number of blocks that each voxel adds, and the range of finest cells that contains all voxels.
layout(local_size_x = 256) in;
layout(std430, binding = 2) restrict writeonly buffer Counts { uint counts[]; };
layout(std430, binding = 3) restrict buffer Bounds { uint minimum[3], maximum[3]; };

shared uint lowest[3], highest[3];

void main() {
    uint own = gl_LocalInvocationIndex, v = gl_GlobalInvocationID.x;
    if (own < 3u) lowest[own] = 0xffffffffu, highest[own] = 0u;
    barrier();
    if (v < voxelCount) {
        uvec2 place = placeAt(v);
        counts[v] = uint(levelOf(place) - firstNewLevel(v));
        uvec3 cell = cellOf(place), end = cell + (1u << riseOf(place));
        for (int axis = 0; axis < 3; ++axis) {
            atomicMin(lowest[axis], cell[axis]);
            atomicMax(highest[axis], end[axis]);
        }
    }
    barrier();
    if (own >= 3u) return;
    if (lowest[own] < minimum[own]) atomicMin(minimum[own], lowest[own]);
    if (highest[own] > maximum[own]) atomicMax(maximum[own], highest[own]);
}
