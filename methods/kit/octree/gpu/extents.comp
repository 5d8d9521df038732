// The extents of the particles along each axis, as sortable keys. Ignores coordinates that are not numbers.
layout(local_size_x = 256) in;
layout(std430, binding = 1) restrict readonly buffer Positions { float positions[]; };
layout(std430, binding = 2) restrict readonly buffer Tally { uint puffs; };
layout(std430, binding = 3) restrict buffer Extents { uint minimum[3], maximum[3]; };

shared uint lowest[3], highest[3];

void main() {
    uint own = gl_LocalInvocationIndex, i = gl_GlobalInvocationID.x;
    if (own < 3u) lowest[own] = 0xffffffffu, highest[own] = 0u;
    barrier();
    for (uint axis = 0u; axis < 3u && i < puffs; ++axis) {
        float value = positions[3u * i + axis];
        if ((floatBitsToUint(value) & 0x7fffffffu) > 0x7f800000u) continue;
        uint key = sortableKey(value);
        atomicMin(lowest[axis], key);
        atomicMax(highest[axis], key);
    }
    barrier();
    // Most groups change nothing: reading first saves them the wait for the same words.
    if (own >= 3u) return;
    if (lowest[own] < minimum[own]) atomicMin(minimum[own], lowest[own]);
    if (highest[own] > maximum[own]) atomicMax(maximum[own], highest[own]);
}
