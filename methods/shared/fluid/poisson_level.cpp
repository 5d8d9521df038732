#include "methods/shared/fluid/poisson_level.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "methods/shared/fluid/poisson_rows.h"

namespace dustbench::fluid {
namespace {

/// Of the six faces of each cell of a row; 0 where a cell is no fluid. A function of its own, so that the compiler sees
/// that bytes written here are none that it reads.
void sumsOfWeights(const std::uint8_t* __restrict own, const CellLayout& cells, std::uint8_t* __restrict sums) {
    const std::uint8_t *below = own - cells.row, *above = own + cells.row, *before = own - cells.slab,
                       *behind = own + cells.slab;
    const auto nx = static_cast<std::size_t>(cells.nx);
    for (std::size_t i = 0; i < nx; ++i) {
        const auto sum =
            static_cast<std::uint8_t>((own - 1)[i] + (own + 1)[i] + below[i] + above[i] + before[i] + behind[i]);
        sums[i] = static_cast<std::uint8_t>(own[i] == 1 ? sum : 0);
    }
}

void split(const std::uint8_t* __restrict row, std::size_t half, std::uint8_t* __restrict even,
           std::uint8_t* __restrict odd) {
    for (std::size_t m = 0; m < half; ++m) {
        even[m] = row[2 * m];
        odd[m] = row[2 * m + 1];
    }
}

}  // namespace

PoissonLevel::PoissonLevel(glm::ivec3 shape, bool isFinest, Arena& arena)
    : layout(shape),
      finest(isFinest),
      pressure(arena.takeField(layout)),
      rightSide(arena.takeField(layout)),
      cells_(shape) {
    if (finest) {
        for (std::uint8_t*& bytes : bytes_) {
            float* memory = arena.take((layout.size() + 3) / 4);
            bytes = reinterpret_cast<std::uint8_t*>(memory);
        }
        return;
    }
    for (SplitField& faces : faces_) faces = arena.takeField(layout);
    sum_ = arena.takeField(layout);
    natural_ = arena.take(cells_.padded());
}

void PoissonLevel::build(const CellLayout& cells, const std::uint8_t* conductance) {
    conductance_ = conductance;
    forRows(layout, [&](int j, int k) {
        const auto nx = static_cast<std::size_t>(layout.nx);
        std::array<std::uint8_t, 4098> sums;
        sumsOfWeights(conductance + cells.at(0, j, k), cells, sums.data());
        sums[nx] = 0;  // where the number of cells is odd
        const int first = (j + k) & 1;
        split(sums.data(), layout.half, bytes_[first] + layout.at(j, k), bytes_[1 - first] + layout.at(j, k));
    });
}

void PoissonLevel::clearPressure() {
    parallel::forEachBlock(layout.size(), 65536, [&](std::size_t first, std::size_t count) {
        for (float* values : pressure.colour) std::memset(values + first, 0, count * sizeof(float));
    });
}

template <bool relaxed>
void PoissonLevel::sweepRow(int colour, int j, int k, const SplitField& target, const SplitField& source,
                            [[maybe_unused]] float relaxation) const {
    const std::size_t at = layout.at(j, k);
    const Around p = aroundRow(layout, source.colour[1 - colour], colour, j, k);
    const float* f = rightSide.colour[colour] + at;
    float* out = target.colour[colour] + at;
    if (finest) {
        const std::uint8_t* weights = bytes_[colour] + at;
        loop(layout.half, [&](std::size_t m) {
            const float sum = (p.here[m] + p.beside[m]) + (p.below[m] + p.above[m]) + (p.near[m] + p.far[m]);
            const auto weight = static_cast<float>(weights[m]);
            const float solved = weight > 0 ? (sum - f[m]) / weight : 0.0f;
            out[m] = relaxed ? out[m] + relaxation * (solved - out[m]) : solved;
        });
    } else {
        const float* weights = sum_.colour[colour] + at;
        const Around w = facesOfRow(layout, faces_, colour, j, k);
        loop(layout.half, [&](std::size_t m) {
            const float sum = (w.here[m] * p.here[m] + w.beside[m] * p.beside[m]) +
                              (w.below[m] * p.below[m] + w.above[m] * p.above[m]) +
                              (w.near[m] * p.near[m] + w.far[m] * p.far[m]);
            const float solved = weights[m] > 0 ? (sum - f[m]) / weights[m] : 0.0f;
            out[m] = relaxed ? out[m] + relaxation * (solved - out[m]) : solved;
        });
    }
}

void PoissonLevel::smooth(float relaxation) {
    const auto sweepSlab = [&](int colour, int k) {
        if (colour == 1 && relaxation != 1)
            for (int j = 0; j < layout.ny; ++j) sweepRow<true>(colour, j, k, pressure, pressure, relaxation);
        else
            for (int j = 0; j < layout.ny; ++j) sweepRow<false>(colour, j, k, pressure, pressure);
    };
    // Black follows red a slab behind, while both are in the cache. Blocks meet at slabs whose red cells come first of
    // all: each black cell then finds its six red neighbours done, and no red one a black that is new.
    const auto nz = static_cast<std::size_t>(layout.nz);
    const std::size_t slabs = std::max<std::size_t>(4, 16384 / (layout.cells() / nz));
    parallel::forEachBlock(nz, slabs, [&](std::size_t first, std::size_t count) {
        sweepSlab(0, static_cast<int>(first));
        if (count > 1) sweepSlab(0, static_cast<int>(first + count - 1));
    });
    parallel::forEachBlock(nz, slabs, [&](std::size_t first, std::size_t count) {
        const int begin = static_cast<int>(first), last = static_cast<int>(first + count) - 1;
        for (int k = begin; k <= last; ++k) {
            if (k + 1 < last) sweepSlab(0, k + 1);
            sweepSlab(1, k);
        }
    });
}

void PoissonLevel::jacobi(const SplitField& other) {
    forRows(layout, [&](int j, int k) {
        sweepRow<false>(0, j, k, other, pressure);
        sweepRow<false>(1, j, k, other, pressure);
    });
}

template <bool keep>
float PoissonLevel::rowResidual(int colour, int j, int k, float* out) const {
    const std::size_t at = layout.at(j, k);
    const Around p = aroundRow(layout, pressure.colour[1 - colour], colour, j, k);
    const float* own = pressure.colour[colour] + at;
    const float* f = rightSide.colour[colour] + at;
    // As integers, the magnitudes of floats have the same order, and what is not a number is the greatest.
    std::int32_t most = 0;
    const auto magnitude = [](float r) { return std::bit_cast<std::int32_t>(r) & 0x7fffffff; };
    if (finest) {
        const std::uint8_t* weights = bytes_[colour] + at;
#pragma GCC ivdep
        for (std::size_t m = 0; m < layout.half; ++m) {
            const float sum = (p.here[m] + p.beside[m]) + (p.below[m] + p.above[m]) + (p.near[m] + p.far[m]);
            const auto weight = static_cast<float>(weights[m]);
            const float r = weight > 0 ? f[m] - (sum - weight * own[m]) : 0.0f;
            if constexpr (keep) out[m] += r;
            most = std::max(most, magnitude(r));
        }
    } else {
        const float* weights = sum_.colour[colour] + at;
        const Around w = facesOfRow(layout, faces_, colour, j, k);
#pragma GCC ivdep
        for (std::size_t m = 0; m < layout.half; ++m) {
            const float sum = (w.here[m] * p.here[m] + w.beside[m] * p.beside[m]) +
                              (w.below[m] * p.below[m] + w.above[m] * p.above[m]) +
                              (w.near[m] * p.near[m] + w.far[m] * p.far[m]);
            const float r = weights[m] > 0 ? f[m] - (sum - weights[m] * own[m]) : 0.0f;
            if constexpr (keep) out[m] += r;
            most = std::max(most, magnitude(r));
        }
    }
    return std::bit_cast<float>(most);
}

template float PoissonLevel::rowResidual<true>(int colour, int j, int k, float* out) const;  // poisson_transfer.cpp

float PoissonLevel::redResidual() const {
    std::atomic<float> most{0};
    forRows(layout, [&](int j, int k) { maximum(most, rowResidual<false>(0, j, k, nullptr)); });
    return most;
}

float PoissonLevel::residual() const {
    std::atomic<float> most{redResidual()};
    forRows(layout, [&](int j, int k) { maximum(most, rowResidual<false>(1, j, k, nullptr)); });
    return most;
}

}  // namespace dustbench::fluid
