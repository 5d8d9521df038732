// Fills the blocks that each voxel adds: empty cells have the medium of the nodes above them.
layout(local_size_x = 256) in;

void main() {
    uint v = gl_GlobalInvocationID.x;
    if (v >= voxelCount) return;
    uvec2 place = placeAt(v);
    int first = firstNewLevel(v), own = levelOf(place);
    if (first == own) return;
    Medium medium = Medium(0.0, vec3(0));
    uint block = firstBlock(v);
    for (int level = 0; level < own; ++level) {
        if (level >= coarsestLevel()) addAt(medium, nodeAt(place, level), v);
        if (level < first) continue;
        for (uint octant = 0u; octant < 8u; ++octant) storeMedium(8u * block + octant, medium);
        ++block;
    }
}
