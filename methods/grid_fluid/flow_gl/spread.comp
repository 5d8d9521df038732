// Smooths the confinement force by (1, 2, 1)/4 along each axis, as flow::applyForces does, and adds the vertical
// forces. Beyond the box it is the force of the outermost cells.
layout(std430, binding = 6) restrict readonly buffer Force { vec4 force[]; };
layout(std430, binding = 5) restrict writeonly buffer Spread { vec4 spread[]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    vec3 sum = vec3(0);
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                ivec3 away = abs(ivec3(x, y, z));
                float share = 0.125 / float(1 << (away.x + away.y + away.z));
                sum += share * force[at(clamp(c + ivec3(x, y, z), ivec3(0), cells - 1))].xyz;
            }
    spread[at(c)] = vec4(sum + vec3(0, force[at(c)].w, 0), 0);
}
