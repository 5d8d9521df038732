// Trilinear sampling in single precision. Positions count cells from the first ghost's centre.
struct Corners {
    int low;
    vec3 share;  // fraction of the way to the next cell
};

Corners cornersAround(vec3 place) {
    ivec3 whole = clamp(ivec3(place), ivec3(0), cells);
    return Corners(whole.x + (cells.x + 2) * (whole.y + (cells.y + 2) * whole.z), place - vec3(whole));
}

#define ALONG_Y(field, c, cell) mix(field[cell], field[(cell) + stepAlong(1)], (c).share.y)
#define IN_PLANE(field, c, cell) mix(ALONG_Y(field, c, cell), ALONG_Y(field, c, (cell) + stepAlong(2)), (c).share.z)
#define SAMPLED(field, c) mix(IN_PLANE(field, c, (c).low), IN_PLANE(field, c, (c).low + 1), (c).share.x)
