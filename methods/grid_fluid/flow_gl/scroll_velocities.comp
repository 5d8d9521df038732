// Moves the velocities of the last step by whole cells; new cells get the wind's velocity.
layout(std430, binding = 1) restrict readonly buffer Last { vec4 last[]; };
layout(std430, binding = 2) restrict writeonly buffer LastThen { vec4 lastThen[]; };
uniform ivec3 by;
uniform vec3 wind;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    lastThen[at(c)] = inside(c + by) ? last[at(c + by)] : vec4(wind, 0);
}
