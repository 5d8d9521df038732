// The speed of the face between a fluid cell and the next one, as in flow::faceSpeed.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };

float faceSpeed(int cell, int to, int axis) {
    float own = moving[cell][axis], other = moving[cell + to][axis];
    return conductance(cell + to) == 0u ? other : 0.5 * (own + other);
}
