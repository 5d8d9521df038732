// Adds density to a list of distinct cells.
struct Added {
    int cell;
    float density;
};
layout(std430, binding = 1) restrict buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer List { Added added[]; };
uniform int count;

void main() {
    int n = groupNumber() * GROUP + int(gl_LocalInvocationIndex);
    if (n < count) moving[added[n].cell].w += added[n].density;
}
