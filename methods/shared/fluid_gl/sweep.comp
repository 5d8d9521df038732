// One colour of a Gauss-Seidel sweep, p = (sum of w p - f) / sum of w; of Jacobi's where the target is another field.
// Source: Trottenberg2001, 2.4; Crane2007, 30.2.3.
layout(std430, binding = 2) writeonly buffer Target { float target[]; };
layout(std430, binding = 4) restrict readonly buffer RightSide { float rightSide[]; };
uniform int colour;

void main() {
    ivec3 c = cellOfColour(colour);
    if (!inside(c)) return;
    float weight = diagonal(c);
    target[place(c)] = weight > 0.0 ? (neighbours(c) - rightSide[place(c)]) / weight : 0.0;
}
