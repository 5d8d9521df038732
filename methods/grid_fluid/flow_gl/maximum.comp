// The maximum magnitude of each quantity of the cells, as bits, which order like the values; NaN is above all others.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 7) restrict buffer Report { uint maximum[]; };

shared uint ofGroup[6];

void main() {
    uint own = gl_LocalInvocationIndex;
    if (own < 6u) ofGroup[own] = 0u;
    barrier();
    ivec3 c = ivec3(gl_GlobalInvocationID) * ivec3(1, 1, COLUMN);
    if (inside(c)) {
        uvec4 movingMaximum = uvec4(0);
        uvec2 carriedMaximum = uvec2(0);
        for (int end = min(c.z + COLUMN, cells.z); c.z < end; ++c.z) {
            movingMaximum = max(movingMaximum, floatBitsToUint(moving[at(c)]) & 0x7fffffffu);
            carriedMaximum = max(carriedMaximum, floatBitsToUint(carried[at(c)]) & 0x7fffffffu);
        }
        for (int lane = 0; lane < 4; ++lane) atomicMax(ofGroup[lane], movingMaximum[lane]);
        for (int lane = 0; lane < 2; ++lane) atomicMax(ofGroup[4 + lane], carriedMaximum[lane]);
    }
    barrier();
    if (own < 6u) atomicMax(maximum[own], ofGroup[own]);
}
