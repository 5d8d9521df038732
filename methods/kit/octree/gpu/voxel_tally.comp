// Completes the number of voxels by the work groups for them, and keeps the maxima of the recorded frames.
layout(local_size_x = 1) in;
layout(std430, binding = 1) restrict buffer Voxels { uint voxels, groups[3]; };

void main() {
    groups = uint[3]((voxels + 255u) / 256u, 1u, 1u);
    uvec4 before = tree.w == 1 ? uvec4(0u) : state.maxima;
    state.maxima = uvec4(max(before.x, state.counts.x), max(before.y, voxels), max(before.z, uint(state.first.w)),
                         before.w + state.counts.y);
}
