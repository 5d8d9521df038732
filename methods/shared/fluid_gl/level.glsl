// Where a level of the pressure's hierarchy has its cells: red ones and black ones apart, as on a chess board, so that
// a sweep over one colour reads whole lines of memory. Rows with a ghost at either end; cell i of row (j, k) has colour
// (i + j + k) mod 2.
int placeIn(ivec3 c, ivec3 size) {
    int row = (size.x + 3) / 2, slab = row * (size.y + 2);
    return (c.x + 1 >> 1) + row * (c.y + 1) + slab * (c.z + 1) + (c.x + c.y + c.z & 1) * slab * (size.z + 2);
}

int place(ivec3 c) {
    return placeIn(c, cells);
}

// The cell of a colour that this thread works on, in threads numbered along x by pairs of cells.
ivec3 cellOfColour(int colour) {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    c.x = 2 * c.x + (c.y + c.z + colour & 1);
    return c;
}
