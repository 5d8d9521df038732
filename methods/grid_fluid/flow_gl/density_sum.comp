// Sums densities over short columns of cells along z, one sum per group of threads, always in the same order.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict writeonly buffer Sums { double sums[]; };
uniform int what;             // 0: all; 1: minus outflow through open sides in a step; 2: in solids
uniform float cellsPerSpeed;  // dt/h

shared double columns[GROUP];

float leaving(ivec3 c, int cell, vec4 record) {
    float sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        int step = stepAlong(axis);
        if (c[axis] == 0 && conductance(cell - step) == 2u) sum += max(-record[axis] * cellsPerSpeed, 0.0);
        if (c[axis] == cells[axis] - 1 && conductance(cell + step) == 2u)
            sum += max(moving[cell + step][axis] * cellsPerSpeed, 0.0);
    }
    return sum * record.w;
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID) * ivec3(1, 1, COLUMN);
    float sum = 0.0;
    if (inside(c))
        for (int end = min(c.z + COLUMN, cells.z); c.z < end; ++c.z) {
            int cell = at(c);
            vec4 record = moving[cell];
            if (what == 2 && isFluid(cell)) continue;
            sum += record.w;
            if (what == 1) sum -= leaving(c, cell, record);
        }
    uint own = gl_LocalInvocationIndex;
    columns[own] = double(sum);
    for (uint width = GROUP / 2; width > 0u; width /= 2u) {
        barrier();
        if (own < width) columns[own] += columns[own + width];
    }
    uvec3 group = gl_WorkGroupID, all = gl_NumWorkGroups;
    if (own == 0u) sums[group.x + all.x * (group.y + all.y * group.z)] = columns[0];
}
