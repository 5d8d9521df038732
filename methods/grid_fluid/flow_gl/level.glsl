// Memory layout of a level of the pressure's hierarchy: red and black cells are separate, as on a chess board, so that
// a sweep over one colour reads whole cache lines. Rows have a ghost at either end; cell i of row (j, k) has colour
// (i + j + k) mod 2.
int placeIn(ivec3 c, ivec3 size) {
    int row = (size.x + 3) / 2, slab = row * (size.y + 2);
    return (c.x + 1 >> 1) + row * (c.y + 1) + slab * (c.z + 1) + (c.x + c.y + c.z & 1) * slab * (size.z + 2);
}

int place(ivec3 c) {
    return placeIn(c, cells);
}

// Index of a cell, and that of the cell with the same number in the other colour (`otherColour`), which contains all of its
// neighbours: along x they are at `otherColour - before` and the next index, along y a row away, along z a slab away.
struct Star {
    int own, otherColour, before, row, slab;
};

Star starAround(ivec3 c) {
    int row = (cells.x + 3) / 2, slab = row * (cells.y + 2), colour = slab * (cells.z + 2);
    int number = (c.x + 1 >> 1) + row * (c.y + 1) + slab * (c.z + 1), black = c.x + c.y + c.z & 1;
    return Star(number + black * colour, number + (1 - black) * colour, c.x & 1, row, slab);
}

// The cell of a colour for this thread; threads are numbered along x by pairs of cells.
ivec3 cellOfColour(int colour) {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    c.x = 2 * c.x + (c.y + c.z + colour & 1);
    return c;
}
