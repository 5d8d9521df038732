// The grid that a kernel works on, one thread per cell.
//
// Cells are laid out as in flow::CellLayout: x runs fastest, with a ghost at either end of each axis.
layout(local_size_x = 32, local_size_y = 4, local_size_z = 1) in;
#define GROUP 128
#define COLUMN 16  // cells along z per thread in reductions

uniform ivec3 cells;

bool inside(ivec3 c) {
    return all(greaterThanEqual(c, ivec3(0))) && all(lessThan(c, cells));
}

// Also the records behind the last cells, which hold the faces on the far sides.
bool insideOrFar(ivec3 c) {
    return all(greaterThanEqual(c, ivec3(0))) && all(lessThanEqual(c, cells));
}

int atIn(ivec3 c, ivec3 size) {
    return c.x + 1 + (size.x + 2) * (c.y + 1 + (size.y + 2) * (c.z + 1));
}

int at(ivec3 c) {
    return atIn(c, cells);
}

int paddedCells() {
    return (cells.x + 2) * (cells.y + 2) * (cells.z + 2);
}

// Stride from a cell to the next along an axis, in cells.
int stepAlong(int axis) {
    return axis == 0 ? 1 : axis == 1 ? cells.x + 2 : (cells.x + 2) * (cells.y + 2);
}

// The velocity at a cell's centre: the mean of its two faces, whose speeds `field` holds.
#define CENTRE_VELOCITY(field, cell) \
    (0.5 * (field[cell].xyz + vec3(field[(cell) + 1].x, field[(cell) + stepAlong(1)].y, field[(cell) + stepAlong(2)].z)))

ivec3 unit(int axis) {
    return ivec3(axis == 0, axis == 1, axis == 2);
}

// Index of this group of threads; may exceed the last.
int groupNumber() {
    return int(gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y);
}
