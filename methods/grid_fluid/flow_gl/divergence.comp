// h times the divergence of each fluid cell, over its faces, as in flow::gatherDivergence.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 4) restrict writeonly buffer RightSide { float rightSide[]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    float sum = 0.0;
    if (isFluid(cell))
        for (int axis = 0; axis < 3; ++axis) sum += moving[cell + stepAlong(axis)][axis] - moving[cell][axis];
    rightSide[place(c)] = sum;
}
