// Replaces each element of a row of tiles by the sum of the elements before it, and records the row's total.
layout(std430, binding = 0) restrict readonly buffer Plan {
    uint count, tiles;
};
layout(std430, binding = 5) restrict writeonly buffer Totals {
    uint totals[];
};
layout(std430, binding = 6) restrict buffer Rows {
    uint rows[];  // one for each work group
};
uniform int firstTotal;

shared uint sumOfBlock;

void main() {
    uint own = ownThread(), row = gl_WorkGroupID.x;
    uint carry = 0u;
    for (uint first = 0u; first < tiles; first += threads) {
        uint tile = first + own;
        uint element = tile < tiles ? rows[row * tiles + tile] : 0u;
        uint sum = inclusiveSums(uvec2(element, 0u)).x;
        if (tile < tiles) rows[row * tiles + tile] = carry + sum - element;
        if (own == threads - 1u) sumOfBlock = sum;
        barrier();
        carry += sumOfBlock;
        barrier();
    }
    if (own == 0u) totals[uint(firstTotal) + row] = carry;
}
