// Trilinear sampling in single precision. Positions count cells from the first ghost, so that a quantity of cell c is
// at c + 1, at the cell's centre or on its face.
struct Corners {
    int low;
    vec3 share;  // fraction of the way to the next cell
};

Corners cornersAround(vec3 place) {
    ivec3 whole = clamp(ivec3(place), ivec3(0), cells);
    return Corners(whole.x + (cells.x + 2) * (whole.y + (cells.y + 2) * whole.z), place - vec3(whole));
}

// The eight surrounding cells in sequence.
int corner(int low, int n) {
    return low + (n & 1) + (n >> 1 & 1) * stepAlong(1) + (n >> 2) * stepAlong(2);
}

vec3 within(vec3 place) {
    return clamp(place, vec3(0), vec3(cells + 1));
}

// `of` selects components: .xy, [axis].
#define ALONG_Y(field, of, c, cell) mix(field[cell] of, field[(cell) + stepAlong(1)] of, (c).share.y)
#define IN_PLANE(field, of, c, cell) mix(ALONG_Y(field, of, c, cell), ALONG_Y(field, of, c, (cell) + stepAlong(2)), (c).share.z)
#define SAMPLED(field, of, c) mix(IN_PLANE(field, of, c, (c).low), IN_PLANE(field, of, c, (c).low + 1), (c).share.x)
