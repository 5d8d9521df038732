// The tiles of a picture: 8 × 8 pixels at level 0, and twice the edge at each further level (tile_lists.h).
uniform ivec3 picture;  // width, height, number of levels

ivec2 tilesOfLevel(int level) {
    return ((picture.xy - 1) >> (level + 3)) + 1;
}

/// Number of tiles at the levels below.
int tilesBelow(int level) {
    int tiles = 0;
    for (int below = 0; below < level; ++below) {
        ivec2 there = tilesOfLevel(below);
        tiles += there.x * there.y;
    }
    return tiles;
}
