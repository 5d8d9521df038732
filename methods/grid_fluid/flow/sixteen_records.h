// Transposes sixteen consecutive records into one vector per quantity. Internal to the kernels.
//
// Eight records are three vectors. Every position belongs to a given pair of quantities (0 and 1, 2 and 3, 4 and 5) in
// exactly one of the three. So a pair of eight records takes one blend, and a quantity one shuffle of two pairs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/lanes.h"

namespace dustbench::grid_fluid::flow {

class SixteenRecords {
 public:
    static constexpr std::size_t count = 16;
    using Quantities = std::array<Float16, lanes>;

    [[gnu::always_inline]] explicit SixteenRecords(const float* records) {
        for (std::size_t v = 0; v < lanes; ++v) vectors_[v] = load<Float16>(records + v * count);
    }
    [[gnu::always_inline]] explicit SixteenRecords(const Quantities& q) {
        putEight<0>(q);
        putEight<1>(q);
    }
    [[gnu::always_inline]] void storeTo(float* records) const {
        for (std::size_t v = 0; v < lanes; ++v) store(records + v * count, vectors_[v]);
    }

    template <int quantity>
    [[gnu::always_inline]] Float16 get() const {
        return shuffled(pair<quantity / 2>(0), pair<quantity / 2>(1),
                        [](int record) { return record / 8 * 16 + (6 * (record % 8) + quantity) % 16; });
    }
    [[gnu::always_inline]] Quantities all() const {
        return {get<0>(), get<1>(), get<2>(), get<3>(), get<4>(), get<5>()};
    }
    [[gnu::always_inline]] friend SixteenRecords operator-(SixteenRecords a, const SixteenRecords& b) {
        for (std::size_t v = 0; v < lanes; ++v) a.vectors_[v] -= b.vectors_[v];
        return a;
    }
    [[gnu::always_inline]] friend SixteenRecords operator+(SixteenRecords a, const SixteenRecords& b) {
        for (std::size_t v = 0; v < lanes; ++v) a.vectors_[v] += b.vectors_[v];
        return a;
    }

 private:
    /// Position `place` of the result is element `which(place)` of the 32 elements of both.
    template <typename Which>
    [[gnu::always_inline]] static Float16 shuffled(const Float16& a, const Float16& b, Which which) {
        return [&]<int... place>(std::integer_sequence<int, place...>) __attribute__((always_inline)) {
            return __builtin_shufflevector(a, b, which(place)...);
        }
        (std::make_integer_sequence<int, 16>{});
    }
    /// Selects each position from one of three vectors: the second if `inSecond(place)`, and so on.
    template <typename Second, typename Third>
    [[gnu::always_inline]] static Float16 blended(const Float16& a, const Float16& b, const Float16& c, Second, Third) {
        const Float16 two = shuffled(a, b, [](int place) { return Second{}(place) ? 16 + place : place; });
        return shuffled(two, c, [](int place) { return Third{}(place) ? 16 + place : place; });
    }
    /// The pair to which a position of vector 0, 1 or 2 of eight records belongs.
    static constexpr int pairAt(int vector, int place) { return (16 * vector + place) % 6 / 2; }

    template <int number>
    [[gnu::always_inline]] Float16 pair(std::size_t half) const {
        const Float16* const v = vectors_.data() + 3 * half;
        return blended(
            v[0], v[1], v[2], [](int place) { return pairAt(1, place) == number; },
            [](int place) { return pairAt(2, place) == number; });
    }
    /// The two quantities of a pair for eight records, each at its position in one of three vectors. 3 is its own
    /// inverse modulo eight.
    template <int number, int half>
    [[gnu::always_inline]] static Float16 paired(const Quantities& q) {
        constexpr std::size_t first = 2 * std::size_t{number};
        return shuffled(q[first], q[first + 1],
                        [](int place) { return place % 2 * 16 + half * 8 + ((3 * (place / 2 - number)) & 7); });
    }
    template <int half>
    [[gnu::always_inline]] void putEight(const Quantities& q) {
        const Float16 a = paired<0, half>(q), b = paired<1, half>(q), c = paired<2, half>(q);
        put<3 * half, 0>(a, b, c);
        put<3 * half + 1, 1>(a, b, c);
        put<3 * half + 2, 2>(a, b, c);
    }
    template <std::size_t to, int vector>
    [[gnu::always_inline]] void put(const Float16& a, const Float16& b, const Float16& c) {
        vectors_[to] = blended(
            a, b, c, [](int place) { return pairAt(vector, place) == 1; },
            [](int place) { return pairAt(vector, place) == 2; });
    }

    std::array<Float16, lanes> vectors_;
};

/// Iterates over a row's cells: `sixteenCells(first)` for sixteen consecutive fluid cells, otherwise `cell(i)` one by
/// one.
template <typename SixteenCells, typename Cell>
[[gnu::always_inline]] inline void forCells(const std::uint8_t* conductance, std::size_t cells,
                                            const SixteenCells& sixteenCells, const Cell& cell) {
    constexpr std::size_t cellsAtOnce = SixteenRecords::count;
    std::size_t i = 0;
    while (i < cells) {
        const std::size_t end = std::min(i + cellsAtOnce, cells);
        const auto isFluid = [](std::uint8_t conducts) { return conducts == 1; };
        if (sixteenAtOnce && end == i + cellsAtOnce && std::all_of(conductance + i, conductance + end, isFluid)) {
            sixteenCells(i);
            i = end;
        } else {
            for (; i < end; ++i) cell(i);
        }
    }
}

}  // namespace dustbench::grid_fluid::flow
