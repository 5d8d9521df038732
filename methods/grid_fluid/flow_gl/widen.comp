// The coarse pressure prepared for interpolation: mirrored at walls, negated at open sides; cells that are entirely
// solid take values from the adjacent fluid.
layout(std430, binding = 1) restrict readonly buffer Pressure { float pressure[]; };
layout(std430, binding = 2) restrict writeonly buffer Wide { float wide[]; };
layout(std430, binding = 3) restrict readonly buffer Faces { vec4 faces[]; };

const int sides[6] = SIDES;  // as flow::Side: 0 open

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID) - 1;
    if (any(greaterThan(c, cells))) return;
    ivec3 nearest = clamp(c, ivec3(0), cells - 1);
    float value = pressure[place(nearest)];
    if (faces[place(nearest)].w <= 0.0) {
        float sum = 0.0, found = 0.0;
        for (int face = 0; face < 6; ++face) {
            ivec3 other = nearest;
            other[face / 2] += face % 2 == 0 ? -1 : 1;
            if (!inside(other) || faces[place(other)].w <= 0.0) continue;
            sum += pressure[place(other)];
            found += 1.0;
        }
        value = found > 0.0 ? sum / found : 0.0;
    }
    for (int axis = 0; axis < 3; ++axis)
        if (c[axis] != nearest[axis] && sides[2 * axis + (c[axis] < 0 ? 0 : 1)] == 0) value = -value;
    wide[at(c)] = value;
}
