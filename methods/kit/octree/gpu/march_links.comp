// Writes the slots of nodes: the block of a node's children, or the medium of a voxel without children.
layout(local_size_x = 256) in;

void main() {
    uint v = gl_GlobalInvocationID.x;
    if (v >= voxelCount) return;
    uvec2 place = placeAt(v);
    int first = firstNewLevel(v), own = levelOf(place);
    // Each new node but the root, in its parent's block.
    for (int level = max(first, 1); level < own; ++level) {
        uint parent = level > first ? firstBlock(v) + uint(level - 1 - first) : blockAt(v, level - 1);
        storeBlock(8u * parent + octantAt(place, level), firstBlock(v) + uint(level - first));
    }
    bool hasChildren = v + 1u < voxelCount && nodeAt(placeAt(v + 1u), own) == place;
    if (hasChildren) return;
    Medium medium = Medium(0.0, vec3(0));
    for (int level = coarsestLevel(); level < own; ++level) addAt(medium, nodeAt(place, level), v);
    add(medium, v);
    uint parent = own > first ? firstBlock(v) + uint(own - 1 - first) : blockAt(v, own - 1);
    storeMedium(8u * parent + octantAt(place, own), medium);
}
