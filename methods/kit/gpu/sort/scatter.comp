// Moves a tile of keys and indices to their places by the current digit, in a stable order. A key goes to
//
//     start of its value  +  keys of this value in earlier tiles  +  its rank among those of its tile
//
// The rank counts earlier keys with the same value: first within a warp of 32 threads, then over the warps. The tile is
// put in order in shared memory, so that neighbouring threads write to neighbouring places.
//
// Without LOOK_BACK, tile_digits.comp and row_sums.comp have counted the earlier tiles. With it, a tile publishes its
// counts at once and its counts with all earlier tiles later, and adds what earlier tiles have published. Tiles are
// numbered by tickets, in the order in which their groups start: an earlier tile is always being worked on, so that
// waiting for it ends if groups that have started make progress (RadixSort::canLookBack).
// Source: AdinetsMerrill2022; MerrillGarland2016. Departs: a state has 32 bits, and is read and written by atomic
// operations alone, so that it needs no fence.
layout(std430, binding = 0) restrict readonly buffer Plan {
    uint count, tiles;
};
layout(std430, binding = 1) restrict readonly buffer Keys {
    uint keys[];
};
layout(std430, binding = 2) restrict readonly buffer Indices {
    uint indices[];
};
layout(std430, binding = 3) restrict writeonly buffer MovedKeys {
    uint movedKeys[];
};
layout(std430, binding = 4) restrict writeonly buffer MovedIndices {
    uint movedIndices[];
};
layout(std430, binding = 5) restrict buffer Totals {
    uint totals[places * values];
    uint tickets[places];
};
layout(std430, binding = 6) restrict buffer States {
    uint states[];  // LOOK_BACK: as in all_digits.comp, else the rows of row_sums.comp
};

// Counts by warp and value, and two tables of masks of the same shape; then the tile's keys or indices in order.
const uint tileCounts = warps * values;
#ifdef SUBGROUPS
const uint tableWords = tileCounts;
#else
const uint tableWords = 3u * tileCounts, masksAt = tileCounts;
#endif
shared uint tileWords[max(tileKeys, tableWords)];
shared uint starts[values];  // place of a value's keys, less their place in the tile
shared uint sharedTile;

uint chosenTile(uint own) {
#ifdef LOOK_BACK
    if (own == 0u) sharedTile = atomicAdd(tickets[place], 1u);
    barrier();
    return sharedTile;
#else
    return gl_WorkGroupID.x;
#endif
}

#ifdef LOOK_BACK
const uint published = 1u << 30, complete = 2u << 30, valueBits = published - 1u;

uint stateAt(uint tile, uint value) {
    return (uint(place) * tiles + tile) * values + value;
}
void publish(uint tile, uint value, uint found) {
    atomicExchange(states[stateAt(tile, value)], found | (tile == 0u ? complete : published));
}
uint countInEarlierTiles(uint tile, uint value, uint found) {
    if (tile == 0u) return 0u;
    uint sum = 0u;
    for (uint earlier = tile; earlier > 0u;) {
        uint state = atomicOr(states[stateAt(earlier - 1u, value)], 0u);
        if (state == 0u) continue;
        sum += state & valueBits;
        if (state >= complete) break;
        --earlier;
    }
    atomicExchange(states[stateAt(tile, value)], (sum + found) | complete);
    return sum;
}
#else
void publish(uint tile, uint value, uint found) {}
uint countInEarlierTiles(uint tile, uint value, uint found) {
    return states[value * tiles + tile];
}
#endif

/// The number of keys with this digit that precede in the warp: of earlier items, and of lower threads in this one.
uint rankInWarp(uint digit, uint item, uint warp, uint lane) {
    uint cell = warp * values + digit;
    uint lower = (1u << lane) - 1u;
#ifdef SUBGROUPS
    uint peers = 0xffffffffu;
    for (uint bit = 0u; bit < 8u; ++bit) {
        bool isSet = (digit >> bit & 1u) != 0u;
        uint set = subgroupBallot(isSet).x;
        peers &= isSet ? set : ~set;
    }
    uint first = uint(findLSB(peers));
    uint before = 0u;
    if (lane == first) before = atomicAdd(tileWords[cell], uint(bitCount(peers)));
    before = subgroupShuffle(before, first);
#else
    // Alternates between two tables, so that clearing a mask does not meet the next item's.
    uint mask = masksAt + (item & 1u) * tileCounts + cell;
    atomicOr(tileWords[mask], 1u << lane);
    barrier();
    uint peers = tileWords[mask], before = tileWords[cell];
    barrier();
    if ((peers & lower) == 0u) {
        tileWords[mask] = 0u;
        tileWords[cell] = before + uint(bitCount(peers));
    }
#endif
    return before + uint(bitCount(peers & lower));
}

void main() {
    uint own = ownThread(), warp = own / warpThreads, lane = own % warpThreads;
    uint tile = chosenTile(own);
    uint first = tile * tileKeys, inTile = min(count - first, tileKeys);
    uint firstOfThread = first + warp * warpThreads * KEYS_PER_THREAD + lane;

    // Missing keys of the last tile follow all others.
    uint key[KEYS_PER_THREAD], at[KEYS_PER_THREAD];
    for (uint item = 0u; item < KEYS_PER_THREAD; ++item) {
        uint index = firstOfThread + item * warpThreads;
        key[item] = index < count ? keys[index] : 0xffffffffu;
    }
    for (uint word = own; word < tableWords; word += threads) tileWords[word] = 0u;
    barrier();
    for (uint item = 0u; item < KEYS_PER_THREAD; ++item) at[item] = rankInWarp(digitOf(key[item]), item, warp, lane);
    barrier();

    // Each thread takes care of one value of the digit.
    uint found = 0u;
    for (uint each = 0u; each < warps; ++each) found += tileWords[each * values + own];
    publish(tile, own, found);
    uint total = totals[uint(place) * values + own];
    uvec2 sums = inclusiveSums(uvec2(found, total));
    uint before = sums.x - found;
    for (uint each = 0u; each < warps; ++each) {
        uint inWarp = tileWords[each * values + own];
        tileWords[each * values + own] = before;
        before += inWarp;
    }
    barrier();
    for (uint item = 0u; item < KEYS_PER_THREAD; ++item) at[item] += tileWords[warp * values + digitOf(key[item])];
    barrier();
    for (uint item = 0u; item < KEYS_PER_THREAD; ++item) tileWords[at[item]] = key[item];
    starts[own] = (sums.y - total) - (sums.x - found) + countInEarlierTiles(tile, own, found);
    barrier();

    uint target[KEYS_PER_THREAD];
    for (uint item = 0u; item < KEYS_PER_THREAD; ++item) {
        uint ordered = item * threads + own;
        uint orderedKey = tileWords[ordered];
        target[item] = starts[digitOf(orderedKey)] + ordered;
        if (ordered < inTile) movedKeys[target[item]] = orderedKey;
    }
    barrier();
    for (uint item = 0u; item < KEYS_PER_THREAD; ++item) {
        uint index = firstOfThread + item * warpThreads;
        if (index < count) tileWords[at[item]] = indices[index];
    }
    barrier();
    for (uint item = 0u; item < KEYS_PER_THREAD; ++item) {
        uint ordered = item * threads + own;
        if (ordered < inTile) movedIndices[target[item]] = tileWords[ordered];
    }
}
