// The coarsest level's pressure, exactly: coarsest_invert.comp provides the inverse of sum of w (pn - p).
layout(std430, binding = 1) restrict writeonly buffer Pressure { float pressure[]; };
layout(std430, binding = 4) restrict readonly buffer RightSide { float rightSide[]; };
layout(std430, binding = 5) restrict readonly buffer Inverse { float inverse[]; };

shared float f[MOST_CELLS];

void main() {
    int own = int(gl_LocalInvocationIndex), n = cells.x * cells.y * cells.z;
    ivec3 c = ivec3(own % cells.x, own / cells.x % cells.y, own / cells.x / cells.y);
    if (own < n) f[own] = rightSide[place(c)];
    barrier();
    if (own >= n) return;
    float sum = 0.0;
    for (int other = 0; other < n; ++other) sum += inverse[own * n + other] * f[other];
    pressure[place(c)] = sum;
}
