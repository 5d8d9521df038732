// The nodes of the tree whose voxels are listed in pre-order. A voxel adds the blocks of those of its ancestors that no
// earlier voxel has: the nodes of levels from `firstNewLevel` to its parent's, numbered in sequence from the root down.
layout(std430, binding = 1) restrict readonly buffer Voxels { uvec4 voxels[]; };
layout(std140, binding = 2) uniform VoxelTally { uint voxelCount; };

uvec2 placeAt(uint v) {
    return voxels[v].xy;
}
int levelOf(uvec2 place) {
    return state.first.w - int(riseOf(place));
}
/// The place of the node of this level that contains a place.
uvec2 nodeAt(uvec2 place, int level) {
    uint rise = uint(state.first.w - level), bits = 3u * rise + 4u;
    uvec2 corner =
        bits < 32u ? uvec2(place.x >> bits << bits, place.y) : uvec2(0u, place.y >> bits - 32u << bits - 32u);
    return uvec2(corner.x | 15u - rise, corner.y);
}
/// Which child contains the place: of the node of the level above.
uint octantAt(uvec2 place, int level) {
    uint bits = 3u * uint(state.first.w - level) + 4u;
    return (bits < 32u ? place.x >> bits | place.y << 32u - bits : place.y >> bits - 32u) & 7u;
}
/// The first of the voxels before `end` that comes after a place.
uint firstAfter(uvec2 place, uint end) {
    uint begin = 0u;
    while (begin < end) {
        uint middle = (begin + end) / 2u;
        uvec2 found = placeAt(middle);
        if (found.y != place.y ? found.y > place.y : found.x > place.x)
            end = middle;
        else
            begin = middle + 1u;
    }
    return begin;
}

/// A node is added by an earlier voxel exactly if the voxel before lies inside it, and below its level.
int firstNewLevel(uint v) {
    if (v == 0u) return 0;
    uvec2 place = placeAt(v), before = placeAt(v - 1u);
    uvec2 differ = uvec2((place.x ^ before.x) >> 4 << 4, place.y ^ before.y);
    int bit = differ.y != 0u ? 32 + findMSB(differ.y) : findMSB(differ.x);
    int alike = bit < 0 ? state.first.w : state.first.w - 1 - (bit - 4) / 3;
    return min(alike + 1, levelOf(before));
}
