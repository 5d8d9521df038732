// Each particle's voxel: its place, and the key to sort by. Counts the particles outside the world.
// Repeats CellKernel (cell_kernel.h).
layout(local_size_x = 256) in;
layout(std430, binding = 1) restrict readonly buffer Positions { float positions[]; };
layout(std430, binding = 2) restrict readonly buffer Tally { uint puffs; };
layout(std430, binding = 3) restrict readonly buffer Lives { float lives[]; };
layout(std430, binding = 4) restrict readonly buffer Looks { float looks[]; };
layout(std430, binding = 5) restrict writeonly buffer Places { uvec2 places[]; };
layout(std430, binding = 6) restrict writeonly buffer Keys { uint keys[]; };
layout(std430, binding = 7) restrict writeonly buffer Indices { uint indices[]; };

const float furthest = 1e9;
shared uint outside, notNumbers;

bool isNumber(float value) {
    return (floatBitsToUint(value) & 0x7fffffffu) <= 0x7f800000u;
}
int cellNumber(float metres) {
    precise float number = metres * scales.x;
    if (!isNumber(number) || number < -furthest) number = -furthest;
    return int(floor(min(number, furthest)));
}
uint riseByAge(float age, float lifetime) {
    float levels = float(tree.y);
    precise float leveled = levels * age;
    float rise = quotient(leveled, lifetime);
    return isNumber(rise) && rise > 0.0 ? uint(min(rise, levels - 1.0)) : 0u;
}
uint riseByRadius(float radius) {
    precise float scaled = scales.z * radius;
    float cells = quotient(scaled, scales.y);
    uint rise = 0u;
    for (int level = 1; level < tree.y; ++level)
        if (cells >= float(1u << (level - 1))) ++rise;
    return rise;
}

void main() {
    uint own = gl_LocalInvocationIndex, i = gl_GlobalInvocationID.x;
    if (own == 0u) outside = 0u, notNumbers = 0u;
    barrier();
    if (i < puffs) {
        vec3 at = vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]);
        uvec3 cell = uvec3(ivec3(cellNumber(at.x), cellNumber(at.y), cellNumber(at.z)) - state.first.xyz);
        bool inside = (cell.x | cell.y | cell.z) < 1u << state.first.w;
        uint rise = rules.y == ruleAge ? riseByAge(lives[2u * i], lives[2u * i + 1u]) : riseByRadius(looks[2u * i]);
        uvec2 place = inside ? placeOf(cell, rise) : uvec2(nowhere);
        places[i] = place;
        keys[i] = inside && hasOneKey() ? preOrder(place) : place.x;
        indices[i] = i;
        if (!inside) atomicAdd(outside, 1u);
        if (!isNumber(at.x) || !isNumber(at.y) || !isNumber(at.z)) atomicAdd(notNumbers, 1u);
    }
    barrier();
    if (own == 0u && outside > 0u) atomicAdd(state.counts.x, outside);
    if (own == 0u && notNumbers > 0u) atomicAdd(state.counts.y, notNumbers);
}
