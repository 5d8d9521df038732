// The shapes that may cover a tile, from the last in their order to the first, 64 at a time: merges the lists of the
// tiles of all levels that contain it. For work groups of 64 invocations; all of them must call these functions.
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

/// Starts with the lists of a tile of level 0.
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
