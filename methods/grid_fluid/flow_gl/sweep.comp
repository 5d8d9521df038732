// One colour of a Gauss-Seidel sweep, p = (sum of w p - f) / sum of w, with the step scaled by `relaxation`
// (flow/poisson_level.h); or of a Jacobi sweep if the target is another field.
// Source: Trottenberg2001, 2.4; Crane2007, 30.2.3.
layout(std430, binding = 2) buffer Target { float target[]; };
layout(std430, binding = 4) restrict readonly buffer RightSide { float rightSide[]; };
uniform int colour;
uniform float relaxation;

void main() {
    ivec3 c = cellOfColour(colour);
    if (!inside(c)) return;
    Star star = starAround(c);
    float weight = diagonal(star);
    float solved = weight > 0.0 ? (neighbours(star) - rightSide[star.own]) / weight : 0.0;
    target[star.own] = relaxation == 1.0 ? solved : target[star.own] + relaxation * (solved - target[star.own]);
}
