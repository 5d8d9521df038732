// Kinds of cells: the lowest two bits are the conductance of a face between the cell and a fluid cell (1 fluid, 2
// beyond an open side, 0 solids, walls and inflows), the bits above are the number of the solid.
layout(std430, binding = 0) restrict readonly buffer Kinds { uint kinds[]; };

uint conductance(int cell) {
    return kinds[cell] & 3u;
}

bool isFluid(int cell) {
    return conductance(cell) == 1u;
}

// Whether the speed of a cell's face towards -x, -y or -z is that of air: between two cells of fluid.
bool moves(int cell, int axis) {
    return isFluid(cell) && isFluid(cell - stepAlong(axis));
}
