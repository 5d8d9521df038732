// Counts the tiles of each shape, at the finest level at which it has at most two columns and two rows of them. EMIT:
// writes a pair of tile and shape for each, in the order of the shapes.
//
// `ivec4 pixelsOf(uint shape)`: the first and the last pixel, x y x y, inclusive and within the picture; the last
// before the first if no pixel.
layout(local_size_x = 256) in;
layout(std430, binding = 1) restrict buffer Ends {
    uint ends[];  // counts; EMIT: their inclusive sums
};
layout(std430, binding = 5) restrict readonly buffer Shapes {
    uint shapes;
};
#ifdef EMIT
layout(std430, binding = 2) restrict writeonly buffer Tiles {
    uint tiles[];
};
layout(std430, binding = 3) restrict writeonly buffer ShapesOfTiles {
    uint shapesOfTiles[];
};
layout(std430, binding = 4) restrict writeonly buffer Pairs {
    uint pairs;
    uint groups[3];  // of tile_ranges.comp
};
#endif

void main() {
    uint shape = gl_GlobalInvocationID.x;
    if (shape >= shapes) return;
    ivec4 pixels = pixelsOf(shape);
    bool seen = all(lessThanEqual(pixels.xy, pixels.zw));
    ivec2 first = pixels.xy >> 3, last = pixels.zw >> 3;
    int level = 0;
    if (seen)
        for (; any(greaterThan(last - first, ivec2(1))); ++level) first >>= 1, last >>= 1;
    ivec2 reach = seen ? last - first + 1 : ivec2(0);
#ifdef EMIT
    uint end = ends[shape];
    if (shape == shapes - 1u) {
        pairs = end;
        groups = uint[3](min((end + 255u) / 256u, 65535u), 1u, 1u);
    }
    uint at = end - uint(reach.x * reach.y);
    int columns = tilesOfLevel(level).x, below = tilesBelow(level);
    for (int row = 0; row < reach.y; ++row)
        for (int column = 0; column < reach.x; ++column, ++at) {
            tiles[at] = uint(below + (first.y + row) * columns + first.x + column);
            shapesOfTiles[at] = shape;
        }
#else
    ends[shape] = uint(reach.x * reach.y);
#endif
}
