// Finds the bricks of a grid with density, and their bounding box; one thread per brick. See brick_map.h.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(binding = 0, r8) restrict writeonly uniform image3D bricks;
layout(binding = 1) uniform sampler3D density;
layout(std430, binding = 0) restrict buffer Bounds {
    ivec4 minimum, maximum;  // in bricks; maximum.w: not 0 if a density is negative or NaN
};
uniform int reach;  // number of cells that a sample reads beyond its own

void main() {
    ivec3 brick = ivec3(gl_GlobalInvocationID), cells = textureSize(density, 0);
    if (any(greaterThanEqual(brick, imageSize(bricks)))) return;
    ivec3 from = max(brick * BRICK - reach, 0), to = min((brick + 1) * BRICK + reach, cells);
    uint maximumBits = 0u;
    for (int z = from.z; z < to.z; ++z)
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x) {
                // Compared as bits: a sign bit, or an exponent of all ones, exceeds the bits of every positive finite
                // number.
                uint bits = floatBitsToUint(texelFetch(density, ivec3(x, y, z), 0).r);
                if (bits != 0x80000000u) maximumBits = max(maximumBits, bits);
            }
    imageStore(bricks, brick, vec4(maximumBits > 0u ? 1 : 0));
    if (maximumBits == 0u) return;
    for (int axis = 0; axis < 3; ++axis) {
        atomicMin(minimum[axis], brick[axis]);
        atomicMax(maximum[axis], brick[axis] + 1);
    }
    if (maximumBits >= 0x7f800000u) atomicMax(maximum.w, 1);
}
