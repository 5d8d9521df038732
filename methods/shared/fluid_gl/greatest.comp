// The greatest magnitude of each number that cells hold, as bits: they have the order of the values, and what is not a
// number is the greatest.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 7) restrict buffer Report { uint greatest[]; };

shared uint most[6];

void main() {
    uint own = gl_LocalInvocationIndex;
    if (own < 6u) most[own] = 0u;
    barrier();
    ivec3 c = ivec3(gl_GlobalInvocationID) * ivec3(1, 1, COLUMN);
    if (inside(c)) {
        uvec4 mostMoving = uvec4(0);
        uvec2 mostCarried = uvec2(0);
        for (int end = min(c.z + COLUMN, cells.z); c.z < end; ++c.z) {
            mostMoving = max(mostMoving, floatBitsToUint(moving[at(c)]) & 0x7fffffffu);
            mostCarried = max(mostCarried, floatBitsToUint(carried[at(c)]) & 0x7fffffffu);
        }
        for (int lane = 0; lane < 4; ++lane) atomicMax(most[lane], mostMoving[lane]);
        for (int lane = 0; lane < 2; ++lane) atomicMax(most[4 + lane], mostCarried[lane]);
    }
    barrier();
    if (own < 6u) atomicMax(greatest[own], most[own]);
}
