// Sets the outermost solid cells to the mean of the adjacent fluid; includes the velocity if solids are frictionless.
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict buffer Carried { vec2 carried[]; };
uniform int slip;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c);
    if (isFluid(cell)) return;
    vec4 movingSum = vec4(0);
    vec2 carriedSum = vec2(0);
    float found = 0.0;
    for (int face = 0; face < 6; ++face) {
        int other = cell + (face % 2 == 0 ? -1 : 1) * stepAlong(face / 2);
        if (!isFluid(other)) continue;
        movingSum += moving[other];
        carriedSum += carried[other];
        found += 1.0;
    }
    if (found == 0.0) return;
    movingSum /= found;
    moving[cell] = slip != 0 ? movingSum : vec4(moving[cell].xyz, movingSum.w);
    carried[cell] = carriedSum / found;
}
