// Flags the first particle of each voxel.
layout(local_size_x = 256) in;
layout(std430, binding = 4) restrict writeonly buffer Flags { uint flags[]; };

void main() {
    uint k = gl_GlobalInvocationID.x;
    if (k >= state.counts.z) return;
    flags[k] = k < particlesInside() && (k == 0u || !shareVoxel(k - 1u, k)) ? 1u : 0u;
}
