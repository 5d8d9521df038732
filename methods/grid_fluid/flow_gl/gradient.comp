// u -= h grad q on all faces of fluid cells, as in flow::subtractGradient.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict writeonly buffer MovingThen { vec4 movingThen[]; };
layout(std430, binding = 5) restrict readonly buffer Pressure { float pressure[]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!insideOrFar(c)) return;
    int cell = at(c);
    vec4 record = moving[cell];
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 before = c;
        before[axis] -= 1;
        ivec3 onFace = c;
        onFace[axis] = 0;
        if (!inside(onFace)) continue;  // the face of another side
        uint own = conductance(cell), other = conductance(cell - stepAlong(axis));
        if (own == 0u || other == 0u) continue;
        record[axis] -= float(max(own, other)) * (pressure[place(c)] - pressure[place(before)]);
    }
    movingThen[cell] = record;
}
