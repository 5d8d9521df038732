// Slots for the ray march (octree_march.h), in textures: blocks, and extinctions summed from the root down.
layout(std430, binding = 2) restrict readonly buffer Ends { uint ends[]; };  // blocks of each voxel and all before it
#ifdef COLOURED
layout(std430, binding = 3) restrict readonly buffer Colours { float colours[]; };
layout(binding = 1, rgba32f) uniform restrict writeonly image2D meanColours;
#endif
layout(binding = 0, r32f) uniform restrict writeonly image2D slots;

/// Extinction of a node and its ancestors, and their colours weighted by it.
struct Medium {
    float extinctionPerMetre;
    vec3 weightedColour;
};

ivec2 texelOf(uint slot) {
    return ivec2(slot & (1u << ROW_BITS) - 1u, slot >> ROW_BITS);
}
void storeBlock(uint slot, uint block) {
    imageStore(slots, texelOf(slot), vec4(block));
}
void storeMedium(uint slot, Medium medium) {
    // −σ·edge·log2(e), per finest cell
    imageStore(slots, texelOf(slot), vec4(float(-edges.x * 1.44269504088896340736lf) * medium.extinctionPerMetre));
#ifdef COLOURED
    float sum = medium.extinctionPerMetre;
    imageStore(meanColours, texelOf(slot), sum > 0.0 ? vec4(medium.weightedColour / sum, 1) : vec4(0));
#endif
}

void add(inout Medium medium, uint v) {
    float edge = float(edges.x * double(1u << riseOf(placeAt(v))));
    float extinction = quotient(quotient(uintBitsToFloat(voxels[v].w), edge * edge), edge);
    medium.extinctionPerMetre += extinction;
#ifdef COLOURED
    medium.weightedColour += extinction * vec3(colours[3u * v], colours[3u * v + 1u], colours[3u * v + 2u]);
#endif
}
/// Adds the voxel at a node that contains voxel v, if there is one.
void addAt(inout Medium medium, uvec2 node, uint v) {
    uint after = firstAfter(node, v);
    if (after > 0u && placeAt(after - 1u) == node) add(medium, after - 1u);
}
int coarsestLevel() {
    return max(1, state.first.w - tree.y + 1);
}

uint firstBlock(uint v) {
    return v == 0u ? 0u : ends[v - 1u];
}
/// The block of the children of the node of this level that contains voxel v.
uint blockAt(uint v, int level) {
    uint adds = firstAfter(nodeAt(placeAt(v), level), v);
    return firstBlock(adds) + uint(level - firstNewLevel(adds));
}
