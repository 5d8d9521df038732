// The velocity at each cell's centre: the mean of its two faces. Beyond the box it is that of the outermost cells.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 5) restrict writeonly buffer Centres { vec4 centres[]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID) - 1;
    if (any(greaterThan(c, cells))) return;
    int cell = at(clamp(c, ivec3(0), cells - 1));
    vec3 next = vec3(moving[cell + 1].x, moving[cell + stepAlong(1)].y, moving[cell + stepAlong(2)].z);
    centres[at(c)] = vec4(0.5 * (moving[cell].xyz + next), 0);
}
