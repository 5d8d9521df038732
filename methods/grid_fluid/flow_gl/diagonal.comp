// The sum of the conductances of the six faces of each fluid cell, on the finest level.
layout(std430, binding = 3) restrict writeonly buffer Diagonal { float diagonals[]; };

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    int cell = at(c), row = cells.x + 2, slab = row * (cells.y + 2);
    uint sum = conductance(cell - 1) + conductance(cell + 1) + conductance(cell - row) + conductance(cell + row) +
               conductance(cell - slab) + conductance(cell + slab);
    diagonals[place(c)] = isFluid(cell) ? float(sum) : 0.0;
}
