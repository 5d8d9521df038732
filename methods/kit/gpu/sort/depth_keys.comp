// Keys that sort depths front to back or back to front, and the indices to sort with them.
layout(std430, binding = 0) restrict readonly buffer Plan {
    uint count, tiles;
};
layout(std430, binding = 1) restrict readonly buffer Depths {
    float depths[];
};
layout(std430, binding = 2) restrict writeonly buffer Keys {
    uint keys[];
};
layout(std430, binding = 3) restrict writeonly buffer Indices {
    uint indices[];
};
uniform bool backToFront;

void main() {
    uint first = gl_WorkGroupID.x * TILE_ELEMENTS, end = min(first + TILE_ELEMENTS, count);
    for (uint index = first + ownThread(); index < end; index += threads) {
        uint key = sortableKey(depths[index]);
        keys[index] = backToFront ? ~key : key;
        indices[index] = index;
    }
}
