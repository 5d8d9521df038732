// Keeps the velocities at the centres for the next step.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict writeonly buffer Last { vec4 last[]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    last[cell] = vec4(CENTRE_VELOCITY(moving, cell), 0);
}
