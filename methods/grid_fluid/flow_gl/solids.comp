// Sets the faces of solids to their speeds, and all quantities at the centre of a solid cell to 0. A face between two
// solids belongs to the one ahead of it.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict buffer Carried { vec2 carried[]; };
struct Motion {
    vec4 velocity, turnPerCell, centreCells;  // velocity.w above 0: each cell has its own velocity
};
layout(std430, binding = 3) restrict readonly buffer Motions { Motion motions[]; };
layout(std430, binding = 4) restrict readonly buffer Velocities { float velocities[]; };  // three per cell, no ghosts
uniform int motionCount;

int bodyAt(ivec3 c) {
    return inside(c) ? int(kinds[at(c)] >> 2) : 0;
}

float speedOf(int body, ivec3 c, int axis) {
    if (body > motionCount) return 0.0;
    Motion motion = motions[body - 1];
    if (motion.velocity.w > 0.0) return velocities[3 * (c.x + cells.x * (c.y + cells.y * c.z)) + axis];
    // A rigid body's speed along an axis is constant along that axis, so the cell's centre can be used for its face.
    return (motion.velocity.xyz + cross(motion.turnPerCell.xyz, vec3(c) + 0.5 - motion.centreCells.xyz))[axis];
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!insideOrFar(c)) return;
    int cell = at(c);
    vec4 record = moving[cell];
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 before = c;
        before[axis] -= 1;
        int own = bodyAt(c), other = bodyAt(before);
        if (own != 0)
            record[axis] = speedOf(own, c, axis);
        else if (other != 0)
            record[axis] = speedOf(other, before, axis);
    }
    if (bodyAt(c) != 0) {
        record.w = 0.0;
        carried[cell] = vec2(0);
    }
    moving[cell] = record;
}
