// Adds to each face the mean force of its two cells; decay and cooling, as in flow::applyForces.
// Source: Senger2009, Eq. 7.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict buffer Carried { vec2 carried[]; };
layout(std430, binding = 6) restrict readonly buffer Force { vec4 force[]; };
uniform float keptDensity, keptHeat, lost;

// Smaller values are set to 0.
float orNothing(float value) {
    return abs(value) <= 1e-18 ? 0.0 : value;
}

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    if (!isFluid(cell)) return;
    vec4 record = moving[cell];
    vec2 burning = carried[cell];
    for (int axis = 0; axis < 3; ++axis)
        if (moves(cell, axis))
            record[axis] = orNothing(record[axis] + 0.5 * (force[cell - stepAlong(axis)][axis] + force[cell][axis]));
    record.w = orNothing(record.w * keptDensity);
    moving[cell] = record;
    carried[cell] = vec2(orNothing(burning.x * keptHeat), max(orNothing(burning.y - lost), 0.0));
}
