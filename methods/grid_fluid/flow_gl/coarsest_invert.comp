// The inverse of the coarsest level's equations, by the sweep operator in double precision, in one group of threads. A
// vanishing pivot fixes its unknown at 0.
layout(std430, binding = 3) restrict readonly buffer Faces { vec4 faces[]; };
layout(std430, binding = 5) restrict writeonly buffer Inverse { float inverse[]; };

shared double matrix[MOST_CELLS * MOST_CELLS];
shared double original[MOST_CELLS];

void main() {
    int own = int(gl_LocalInvocationIndex), n = cells.x * cells.y * cells.z;
    for (int e = own; e < n * n; e += GROUP) matrix[e] = 0.0lf;
    barrier();
    if (own < n) {
        ivec3 c = ivec3(own % cells.x, own / cells.x % cells.y, own / cells.x / cells.y);
        vec4 face = faces[place(c)];
        // In double precision, so that in a closed region it is the sum of the other weights to within 1e-16 of it.
        double sum = 0.0lf;
        for (int axis = 0; axis < 3; ++axis) {
            ivec3 before = c;
            before[axis] -= 1;
            sum += double(face[axis]) + double(faces[place(before)][axis]);
        }
        original[own] = matrix[own * n + own] = sum;
        ivec3 apart = ivec3(1, cells.x, cells.x * cells.y);
        for (int axis = 0; axis < 3; ++axis) {
            if (c[axis] + 1 == cells[axis]) continue;
            int other = own + apart[axis];
            matrix[own * n + other] = matrix[other * n + own] = -double(face[axis]);
        }
    }
    for (int p = 0; p < n; ++p) {
        barrier();
        double pivot = matrix[p * n + p];
        bool vanishes = !(pivot > 1e-7lf * original[p]);
        for (int e = own; e < n * n; e += GROUP) {
            int r = e / n, c = e % n;
            if (r == p || c == p) continue;
            if (!vanishes) matrix[e] -= matrix[r * n + p] * matrix[p * n + c] / pivot;
        }
        barrier();
        for (int r = own; r < n; r += GROUP) {
            double scaled = vanishes ? 0.0lf : r == p ? -1.0lf / pivot : matrix[r * n + p] / pivot;
            matrix[r * n + p] = matrix[p * n + r] = scaled;
        }
    }
    barrier();
    for (int e = own; e < n * n; e += GROUP) inverse[e] = float(matrix[e]);
}
