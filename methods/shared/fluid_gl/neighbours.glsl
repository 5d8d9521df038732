// The sum over a cell's six neighbours, by what their faces conduct, and what all of them conduct together. On the
// finest level the pressure is 0 wherever a face conducts anything but 1.
layout(std430, binding = 1) readonly buffer Pressure { float pressure[]; };
#ifdef FINEST
layout(std430, binding = 3) restrict readonly buffer Diagonal { float diagonals[]; };

float diagonal(ivec3 c) {
    return diagonals[place(c)];
}

float neighbours(ivec3 c) {
    return pressure[place(c - ivec3(1, 0, 0))] + pressure[place(c + ivec3(1, 0, 0))] +
           (pressure[place(c - ivec3(0, 1, 0))] + pressure[place(c + ivec3(0, 1, 0))]) +
           (pressure[place(c - ivec3(0, 0, 1))] + pressure[place(c + ivec3(0, 0, 1))]);
}
#else
// The faces to the next cells along x, y and z, and the sum of all six.
layout(std430, binding = 3) restrict readonly buffer Faces { vec4 faces[]; };

float diagonal(ivec3 c) {
    return faces[place(c)].w;
}

float neighbours(ivec3 c) {
    vec4 own = faces[place(c)];
    float sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 next = ivec3(0);
        next[axis] = 1;
        int before = place(c - next);
        sum += faces[before][axis] * pressure[before] + own[axis] * pressure[place(c + next)];
    }
    return sum;
}
#endif
