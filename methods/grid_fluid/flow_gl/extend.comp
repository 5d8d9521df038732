// Sets the rim inside the solids to the mean of adjacent moving values, as flow::SolidCells::extendInto: at centres,
// and on faces between two solid cells if solids are frictionless.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict buffer Carried { vec2 carried[]; };
uniform int slip;

int neighbourAcross(int cell, int face) {
    return cell + (face % 2 == 0 ? -1 : 1) * stepAlong(face / 2);
}

void extendCentre(int cell) {
    vec3 sum = vec3(0);
    float found = 0.0;
    for (int face = 0; face < 6; ++face) {
        int other = neighbourAcross(cell, face);
        if (!isFluid(other)) continue;
        sum += vec3(moving[other].w, carried[other]);
        found += 1.0;
    }
    if (found == 0.0) return;
    moving[cell].w = sum.x / found;
    carried[cell] = sum.yz / found;
}

void extendFace(int cell, int axis) {
    float sum = 0.0, found = 0.0;
    for (int face = 0; face < 6; ++face) {
        int other = neighbourAcross(cell, face);
        if (!moves(other, axis)) continue;
        sum += moving[other][axis];
        found += 1.0;
    }
    if (found == 0.0) return;
    // Other threads read the other components.
    if (axis == 0) moving[cell].x = sum / found;
    else if (axis == 1) moving[cell].y = sum / found;
    else moving[cell].z = sum / found;
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    if (isFluid(cell)) return;
    extendCentre(cell);
    if (slip == 0) return;
    for (int axis = 0; axis < 3; ++axis)
        if (!isFluid(cell - stepAlong(axis))) extendFace(cell, axis);  // otherwise it is the surface itself
}
