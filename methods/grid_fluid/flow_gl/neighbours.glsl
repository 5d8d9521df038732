// The sum over a cell's six neighbours weighted by the conductances of their faces, and the sum of the conductances. On
// the finest level the pressure is 0 wherever a face conducts a value other than 1.
layout(std430, binding = 1) readonly buffer Pressure { float pressure[]; };
#ifdef FINEST
layout(std430, binding = 3) restrict readonly buffer Diagonal { float diagonals[]; };

float diagonal(Star star) {
    return diagonals[star.own];
}

float neighbours(Star star) {
    int x = star.otherColour - star.before;
    return pressure[x] + pressure[x + 1] + (pressure[star.otherColour - star.row] + pressure[star.otherColour + star.row]) +
           (pressure[star.otherColour - star.slab] + pressure[star.otherColour + star.slab]);
}
#else
// The faces to the next cells along x, y and z, and the sum of all six.
layout(std430, binding = 3) restrict readonly buffer Faces { vec4 faces[]; };

float diagonal(Star star) {
    return faces[star.own].w;
}

float neighbours(Star star) {
    vec4 own = faces[star.own];
    int x = star.otherColour - star.before, y = star.otherColour - star.row, z = star.otherColour - star.slab;
    return faces[x].x * pressure[x] + own.x * pressure[x + 1] +
           (faces[y].y * pressure[y] + own.y * pressure[star.otherColour + star.row]) +
           (faces[z].z * pressure[z] + own.z * pressure[star.otherColour + star.slab]);
}
#endif
