// Combines each tile of elements into one value, or all tiles' values into one: COMBINE of two values, IDENTITY for none.
//
// The order of combination depends on the number of elements alone, so that sums of floats repeat to the bit.
layout(std430, binding = 0) restrict readonly buffer Plan {
    uint count, tiles;
};
layout(std430, binding = 1) restrict readonly buffer Elements {
    NUMBER elements[];
};
layout(std430, binding = 6) restrict writeonly buffer Results {
    NUMBER results[];  // one for each work group
};
uniform bool overTiles;  // the elements are the tiles' values, and there is one work group

shared NUMBER ofThreads[threads];

void main() {
    uint own = ownThread();
    uint first = overTiles ? 0u : gl_WorkGroupID.x * TILE_ELEMENTS;
    uint end = overTiles ? tiles : min(first + TILE_ELEMENTS, count);
    NUMBER result = IDENTITY;
    for (uint index = first + own; index < end; index += threads) {
        NUMBER element = LOADED(elements[index]);
        result = COMBINE(result, element);
    }
    ofThreads[own] = result;
    for (uint width = threads / 2u; width > 0u; width /= 2u) {
        barrier();
        if (own < width) {
            NUMBER other = ofThreads[own + width];
            result = COMBINE(result, other);
            ofThreads[own] = result;
        }
    }
    if (own == 0u) results[gl_WorkGroupID.x] = result;
}
