// The voxels as puffs to draw: centre, edge or radius, opacity or optical depth, colour.
layout(local_size_x = 256) in;
layout(std430, binding = 1) restrict readonly buffer Voxels { uvec4 voxels[]; };
layout(std430, binding = 2) restrict writeonly buffer Positions { float positions[]; };
layout(std430, binding = 3) restrict writeonly buffer Looks { float looks[]; };
#ifdef COLOURED
layout(std430, binding = 4) restrict readonly buffer DustColours { float dustColours[]; };
layout(std430, binding = 5) restrict writeonly buffer Colours { float colours[]; };
#endif
layout(std140, binding = 2) uniform VoxelTally { uint voxelCount; };

/// 1 − exp(−x); a series for small x, where the difference from 1 would lose digits.
float opacityOf(float x) {
    if (x > 0.05) return 1.0 - exp(-x);
    return x * (1.0 - x / 2.0 * (1.0 - x / 3.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0))));
}

void main() {
    uint v = gl_GlobalInvocationID.x;
    if (v >= voxelCount) return;
    uvec4 voxel = voxels[v];
    double cells = double(1u << riseOf(voxel.xy));
    precise dvec3 centre = state.origin.xyz + edges.x * (dvec3(cellOf(voxel.xy)) + cells / 2.0lf);
    float edge = float(edges.x * cells), mass = uintBitsToFloat(voxel.w);
    float opticalDepth = quotient(mass, edge * edge);
    vec3 at = vec3(centre);
    for (uint axis = 0u; axis < 3u; ++axis) positions[3u * v + axis] = at[axis];
    bool isCube = drawn.x == 1;
    looks[2u * v] = isCube ? edge : edge / shown.x;
    looks[2u * v + 1u] = isCube ? opticalDepth : min(opacityOf(opticalDepth), 0.99999);
#ifdef COLOURED
    for (uint channel = 0u; channel < 3u; ++channel)
        colours[3u * v + channel] = dustColours[3u * voxel.z + channel];
#endif
}
