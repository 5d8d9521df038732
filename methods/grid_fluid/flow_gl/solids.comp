// Sets cells in solids to the solid's velocity and all other quantities to 0.
layout(std430, binding = 1) restrict writeonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict writeonly buffer Carried { vec2 carried[]; };
struct Motion {
    vec4 velocity, turnPerCell, centreCells;
};
layout(std430, binding = 3) restrict readonly buffer Motions { Motion motions[]; };
uniform int motionCount;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int body = int(kinds[at(c)] >> 2);
    if (body == 0) return;
    vec3 velocity = vec3(0);
    if (body <= motionCount) {
        Motion motion = motions[body - 1];
        velocity = motion.velocity.xyz + cross(motion.turnPerCell.xyz, vec3(c) + 0.5 - motion.centreCells.xyz);
    }
    moving[at(c)] = vec4(velocity, 0);
    carried[at(c)] = vec2(0);
}
