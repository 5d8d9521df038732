// Draws the shapes that may cover a tile of 8 × 8 pixels, an invocation for each pixel, from the last shape in their order
// to the first. The lists of the tiles of all levels that contain the tile are merged, 64 shapes at a time.
//
// A shader with this piece calls drawTile() from its `main`, and defines:
layout(local_size_x = 8, local_size_y = 8) in;

/// Prepares a shape in a slot of shared memory, and calls `cover`. `tilePixel`: first pixel of the tile.
void prepareShape(uint slot, uint shape, ivec2 tilePixel);
/// Draws the shape in a slot at the invocation's pixel.
void drawShape(uint slot);
/// Whether further shapes can change the invocation's pixel. The tile ends when this is true for none.
bool needsMore();

layout(std430, binding = 1) restrict readonly buffer Ranges {
    uvec2 ranges[];  // begin and end of each tile's list
};
layout(std430, binding = 2) restrict readonly buffer ShapesOfTiles {
    uint shapesOfTiles[];
};

const uint shapesAtOnce = 64u;
const uint maximumLevels = 12u;
shared uvec2 lists[maximumLevels];  // the rest of each list that is not empty: begin and end
shared uint listCount;
shared uint heads[maximumLevels * shapesAtOnce];  // last shapes of each list's rest, plus 1; 0: none
shared uint takenOf[maximumLevels];
shared uint merged[shapesAtOnce];
shared uvec2 coveredBy[shapesAtOnce];  // pixels of the shape in a slot
shared uint shapesIn[4];               // slots of shapes in the lower four rows, 32 bits each, then in the upper four
shared uint wanting;                   // whether a pixel needs more

/// For prepareShape: a bit for each pixel that the shape covers, row by row (quad_pixels.glsl).
void cover(uint slot, uvec2 pixels) {
    coveredBy[slot] = pixels;
    uint bit = 1u << (slot & 31u), word = slot >> 5;
    if (pixels.x != 0u) atomicOr(shapesIn[word], bit);
    if (pixels.y != 0u) atomicOr(shapesIn[2u + word], bit);
}

/// Starts with the lists of a tile of level 0. All invocations must call this and the next functions.
void openLists(ivec2 tile, uint slot) {
    if (slot < uint(picture.z)) {
        int level = int(slot);
        ivec2 place = tile >> level;
        lists[slot] = ranges[tilesBelow(level) + place.y * tilesOfLevel(level).x + place.x];
        takenOf[slot] = 0u;
    }
    barrier();
    if (slot == 0u) {
        uint found = 0u;
        for (int level = 0; level < picture.z; ++level)
            if (lists[level].x < lists[level].y) lists[found++] = lists[level];
        listCount = found;
    }
    barrier();
}

/// Number of the list's last shapes, out of 64, that come after `shape`.
uint shapesAfter(uint list, uint shape) {
    uint low = 0u, high = shapesAtOnce;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (heads[list * shapesAtOnce + middle] > shape) low = middle + 1u;
        else high = middle;
    }
    return low;
}

/// Returns the number of shapes found, at most 64. Each invocation whose slot is below it gets one, in the slots'
/// order. There is a barrier at the beginning. The caller must have another barrier between two calls.
uint nextShapes(uint slot, out uint shape) {
    uint left = 0u;
    for (uint list = 0u; list < listCount; ++list) {
        uvec2 rest = lists[list];
        left += rest.y - rest.x;
        heads[list * shapesAtOnce + slot] = slot < rest.y - rest.x ? shapesOfTiles[rest.y - 1u - slot] + 1u : 0u;
    }
    barrier();
    shape = 0u;
    if (left == 0u) return 0u;
    uint found = min(left, shapesAtOnce);
    if (listCount == 1u) {
        shape = heads[slot] - 1u;
        if (slot == 0u) lists[0].y -= found;
        return found;
    }
    // A shape's place is the number of shapes after it, in its own list and in the others.
    for (uint list = 0u; list < listCount; ++list) {
        uint own = heads[list * shapesAtOnce + slot], place = slot;
        if (own == 0u) continue;
        for (uint other = 0u; other < listCount && place < shapesAtOnce; ++other)
            if (other != list) place += shapesAfter(other, own);
        if (place >= shapesAtOnce) continue;
        merged[place] = own - 1u;
        atomicMax(takenOf[list], slot + 1u);
    }
    barrier();
    if (slot < listCount) {
        lists[slot].y -= takenOf[slot];
        takenOf[slot] = 0u;
    }
    shape = slot < found ? merged[slot] : 0u;
    return found;
}

/// False if no shape may cover the tile; then nothing was called.
bool drawTile() {
    uint own = gl_LocalInvocationIndex, rows = own >> 5, bit = 1u << (own & 31u);
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    openLists(tile, own);
    if (listCount == 0u) return false;
    bool more = true;
    while (more) {
        if (own < 4u) shapesIn[own] = 0u;
        if (own == 0u) wanting = 0u;
        uint shape, found = nextShapes(own, shape);
        if (own < found) prepareShape(own, shape, 8 * tile);
        if (needsMore()) wanting = 1u;
        barrier();
        bool wanted = wanting > 0u;
        more = found == shapesAtOnce && wanted;
        for (uint word = 0u; wanted && word < 2u; ++word)
            for (uint left = shapesIn[2u * rows + word]; left != 0u; left &= left - 1u) {
                uint slot = 32u * word + uint(findLSB(left));
                uint pixels = rows == 0u ? coveredBy[slot].x : coveredBy[slot].y;
                if ((pixels & bit) != 0u) drawShape(slot);
            }
        barrier();
    }
    if (isCutShort()) atomicAdd(unfinished, 1u);
    return true;
}
