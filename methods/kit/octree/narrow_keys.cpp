#include "methods/kit/octree/narrow_keys.h"

#include <array>
#include <cstring>

namespace dustbench::octree {
namespace {

#ifdef __AVX512F__

/// A number for each four-bit value, looked up in a register for sixteen particles at once.
struct alignas(64) FourBitTable {
    template <typename NumberOf>
    explicit constexpr FourBitTable(const NumberOf& numberOf) {
        for (std::uint32_t bits = 0; bits < numbers.size(); ++bits) numbers[bits] = numberOf(bits);
    }
    std::array<std::uint32_t, 16> numbers{};
};

/// Codes and places are sums of one contribution per coordinate; this is the contribution of one coordinate's bits.
template <int axis>
constexpr std::uint32_t codeAlong(std::uint32_t bits) {
    return spreadByte(bits) << (2 - axis);
}
template <int axis>
constexpr FourBitTable codes(codeAlong<axis>);
template <int axis>
constexpr FourBitTable places([](std::uint32_t bits) {
    return placeInBrick(codeAlong<axis>(bits), 0) - placeInBrick(0, 0);
});
/// By rise: mask of the remaining bits of a coordinate, and the place of the brick's first cell of that rise.
constexpr FourBitTable leftOfRise([](std::uint32_t rise) { return rise < brickRise ? 15u >> rise << rise : 0u; });
constexpr FourBitTable firstOfRise([](std::uint32_t rise) { return placeInBrick(0, rise); });

/// Ignores all but the lowest four bits.
Sixteen lookUp(const FourBitTable& table, Sixteen bits) {
    const __m512i numbers = _mm512_load_si512(table.numbers.data());
    return Sixteen(_mm512_maskz_permutexvar_epi32(0xffff, __m512i(bits), numbers));
}

Sixteen bricksOf(const SixteenCells& cells) {
    return lookUp(codes<0>, cells.x >> 4) | lookUp(codes<1>, cells.y >> 4) | lookUp(codes<2>, cells.z >> 4);
}
Sixteen placesInBricks(const SixteenCells& cells) {
    const Sixteen left = lookUp(leftOfRise, cells.rise);
    return lookUp(places<0>, cells.x & left) + lookUp(places<1>, cells.y & left) + lookUp(places<2>, cells.z & left) +
           lookUp(firstOfRise, cells.rise);
}

#endif

}  // namespace

template <LevelRule rule>
void makeNarrowKeys(const CellKernel<rule>& kernel, std::size_t first, std::size_t count, std::uint32_t bricks,
                    std::uint32_t* keys) {
    const CellKernel<rule> cellsOf = kernel;  // a copy, so that the compiler knows that it does not alias the keys
    std::size_t i = 0;
#ifdef __AVX512F__
    for (; i + 16 <= count; i += 16) {
        const SixteenCells cells = cellsOf.sixteen(first + i);
        Sixteen bins = bricksOf(cells);
        bins = cells.rise > std::uint32_t{brickRise} ? Sixteen{} + bricks : bins;
        bins = cells.outside ? Sixteen{} + (bricks + 1) : bins;
        const Sixteen made = bins << brickPlaceBits | placesInBricks(cells);
        std::memcpy(keys + i, &made, sizeof(made));
    }
#endif
    for (; i < count; ++i) keys[i] = narrowKey(cellsOf, first + i, bricks);
}

template void makeNarrowKeys(const CellKernel<LevelRule::age>&, std::size_t, std::size_t, std::uint32_t,
                             std::uint32_t*);
template void makeNarrowKeys(const CellKernel<LevelRule::radius>&, std::size_t, std::size_t, std::uint32_t,
                             std::uint32_t*);

}  // namespace dustbench::octree
