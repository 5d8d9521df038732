// What cells are: in the lowest two bits what a face between one and a cell of fluid conducts (1 fluid, 2 beyond an
// open side, 0 solids, walls and inflows), above them the number of the solid.
layout(std430, binding = 0) restrict readonly buffer Kinds { uint kinds[]; };

uint conductance(int cell) {
    return kinds[cell] & 3u;
}

bool isFluid(int cell) {
    return conductance(cell) == 1u;
}
