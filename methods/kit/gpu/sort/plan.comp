// Reads the number of elements from a buffer, and divides the elements into tiles.
layout(local_size_x = 1) in;
layout(std430, binding = 0) restrict writeonly buffer Plan {
    uint count, tiles;
    uint groupPerTile[3];
    uint groupPerShare[3];
};
layout(std430, binding = 1) restrict readonly buffer Counts {
    uint counts[];
};
uniform int word;  // of the number in its buffer
uniform int capacity;
uniform int tileElements;
uniform int maximumShares;

void main() {
    uint elements = min(counts[word], uint(capacity));
    uint needed = (elements + uint(tileElements) - 1u) / uint(tileElements);
    count = elements;
    tiles = needed;
    groupPerTile = uint[3](needed, 1u, 1u);
    groupPerShare = uint[3](min(needed, uint(maximumShares)), 1u, 1u);
}
