// Adds up the blocks of one level, each from sixteen particles or blocks of the level below: no thread has to add up all
// particles of a voxel one by one.
layout(local_size_x = 256) in;
uniform int level;

void main() {
    uint number = gl_GlobalInvocationID.x, bits = blockBits * uint(level + 1), first = number << bits;
    uint last = first + (1u << bits) - 1u;
    if (last >= particlesInside() || !shareVoxel(first, last)) return;
    uint rise = riseOf(places[indices[first]]);
    Sum sum = nobody;
    for (uint part = 16u * number; part < 16u * number + 16u; ++part)
        if (level == 0)
            sum = added(sum, sumOf(indices[part], rise));
        else
            sum = added(sum, sumIn(blocks[blockIndex(uint(level - 1), part)]));
    blocks[blockIndex(uint(level), number)] = wordsOf(sum);
}
