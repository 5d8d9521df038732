#include "methods/grid_fluid/flow/poisson_level.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/poisson_rows.h"
#include "methods/kit/parallel/for_stages.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// Sums the weights of the six faces of each cell of a row; 0 for cells that are not fluid. A separate function, so
/// that the compiler sees that the bytes written do not alias the bytes read.
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

constexpr std::size_t fewLevelCells = 4096;  ///< too few for a second thread

/// Inverse of the sum of a cell's weights, 0 outside the fluid.
class Reciprocals {
 public:
    [[gnu::always_inline]] Reciprocals() {
        for (int weight = 1; weight < 16; ++weight) table_[weight] = 1.0f / static_cast<float>(weight);
    }
    [[gnu::always_inline]] [[nodiscard]] Float16 of(const std::uint8_t* weights) const {
        const Int16 weight = widened(weights);
        if constexpr (sixteenAtOnce) return lanes::lookUp(table_, weight);
        const Float16 number = __builtin_convertvector(weight, Float16);
        return number > 0 ? 1.0f / number : Float16{};
    }

 private:
    Float16 table_{};
};

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
        sums[nx] = 0;  // if the number of cells is odd
        const int first = (j + k) & 1;
        const std::size_t at = layout.at(j, k);
        split(sums.data(), layout.half, bytes_[first] + at, bytes_[1 - first] + at);
        // The last sixteen cells may extend beyond the row's end; those entries are not solved.
        const std::size_t beyond = (16 - layout.half % 16) % 16;
        for (int colour = 0; colour < 2; ++colour) {
            std::fill_n(bytes_[colour] + at + layout.half, beyond, std::uint8_t{0});
            std::fill_n(rightSide.colour[colour] + at + layout.half, beyond, 0.0f);
        }
    });
}

void PoissonLevel::clearPressure() {
    parallel::forEachBlock(layout.size(), 65536, [&](std::size_t first, std::size_t count) {
        for (float* values : pressure.colour) std::memset(values + first, 0, count * sizeof(float));
    });
}

void PoissonLevel::clearGhosts() {
    const auto clear = [&](int j, int k, std::size_t rows) {
        for (float* values : pressure.colour) std::fill_n(values + layout.at(j, k), rows * layout.row, 0.0f);
    };
    for (float* values : pressure.colour) std::fill_n(values, SplitLayout::front, 0.0f);
    const std::size_t rowsOfSlab = static_cast<std::size_t>(layout.ny) + 2;
    clear(-1, -1, rowsOfSlab);
    clear(-1, layout.nz, rowsOfSlab);
    for (int k = 0; k < layout.nz; ++k) {
        clear(-1, k, 1);
        clear(layout.ny, k, 1);
    }
}

template <PoissonLevel::Guess guess, bool relaxed>
void PoissonLevel::sweepRow(int colour, int j, int k, const SplitField& target, const SplitField& source,
                            [[maybe_unused]] float relaxation) const {
    const std::size_t at = layout.at(j, k);
    const Around p = aroundRow(layout, source.colour[1 - colour], colour, j, k);
    const float* f = rightSide.colour[colour] + at;
    float* out = target.colour[colour] + at;
    const auto step = [&]<typename Number>([[maybe_unused]] const Number& own, const Number& solved) {
        if constexpr (!relaxed) return solved;
        if constexpr (guess == Guess::memory) return own + relaxation * (solved - own);
        return relaxation * solved;
    };
    if (finest) {
        const std::uint8_t* weights = bytes_[colour] + at;
        const Reciprocals reciprocals;
        for (std::size_t m = 0; m < layout.half; m += 16) {
            const Float16 sum = guess == Guess::zero ? Float16{} : p.sixteen(m);
            const Float16 solved = (sum - load<Float16>(f + m)) * reciprocals.of(weights + m);
            store(out + m, step(load<Float16>(out + m), solved));
        }
    } else {
        const float* weights = sum_.colour[colour] + at;
        const Around w = facesOfRow(layout, faces_, colour, j, k);
        loop(layout.half, [&](std::size_t m) {
            const float sum = guess == Guess::zero ? 0.0f
                                                   : (w.here[m] * p.here[m] + w.beside[m] * p.beside[m]) +
                                                         (w.below[m] * p.below[m] + w.above[m] * p.above[m]) +
                                                         (w.near[m] * p.near[m] + w.far[m] * p.far[m]);
            const float solved = weights[m] > 0 ? (sum - f[m]) / weights[m] : 0.0f;
            out[m] = step(out[m], solved);
        });
    }
    if constexpr (guess != Guess::memory) std::fill(out + layout.half, out + layout.row, 0.0f);
}

void PoissonLevel::sweepRed(bool fromZero, int k) {
    for (int j = 0; j < layout.ny; ++j)
        fromZero ? sweepRow<Guess::zero, false>(0, j, k, pressure, pressure)
                 : sweepRow<Guess::memory, false>(0, j, k, pressure, pressure);
}

void PoissonLevel::sweepBlack(bool fromZero, float relaxation, int k) {
    for (int j = 0; j < layout.ny; ++j)
        if (relaxation == 1)
            fromZero ? sweepRow<Guess::ownZero, false>(1, j, k, pressure, pressure)
                     : sweepRow<Guess::memory, false>(1, j, k, pressure, pressure);
        else
            fromZero ? sweepRow<Guess::ownZero, true>(1, j, k, pressure, pressure, relaxation)
                     : sweepRow<Guess::memory, true>(1, j, k, pressure, pressure, relaxation);
}

float PoissonLevel::smooth(const Pass& pass) {
    if (pass.fromZero) clearGhosts();
    // Stage 0 is the correction, then red and black alternate. A restriction processes two slabs at once and therefore
    // lags one slab more.
    const std::size_t halfSweeps = 2 * pass.relaxations.size();
    const std::size_t stages = halfSweeps + (pass.restriction != nullptr ? 3 : 1);
    const std::size_t blocks = layout.cells() < fewLevelCells ? 1 : 2 * parallel::threadCount();
    std::atomic<float> maximum{0};
    parallel::forStages(static_cast<std::size_t>(layout.nz), stages, blocks, [&](std::size_t stage, std::size_t slab) {
        const int k = static_cast<int>(slab);
        if (stage == 0) {
            if (pass.correction != nullptr) addToBlack(*pass.correction, k);
        } else if (stage <= halfSweeps) {
            const bool fromZero = pass.fromZero && stage <= 2;
            const float relaxation = pass.relaxations[(stage - 1) / 2];
            stage % 2 == 1 ? sweepRed(fromZero, k) : sweepBlack(fromZero, relaxation, k);
        } else if (stage == halfSweeps + 2 && (k % 2 == 1 || k + 1 == layout.nz)) {
            raiseTo(maximum, restrictTo(*pass.restriction, k));
        }
    });
    return maximum;
}

void PoissonLevel::jacobi(const SplitField& other) {
    forRows(layout, [&](int j, int k) {
        sweepRow<Guess::memory, false>(0, j, k, other, pressure);
        sweepRow<Guess::memory, false>(1, j, k, other, pressure);
    });
}

template <bool keep>
float PoissonLevel::rowResidual(int colour, int j, int k, float* out) const {
    const std::size_t at = layout.at(j, k);
    const Around p = aroundRow(layout, pressure.colour[1 - colour], colour, j, k);
    const float* own = pressure.colour[colour] + at;
    const float* f = rightSide.colour[colour] + at;
    // As integers, the magnitudes of floats have the same order, and NaN is above all others.
    std::int32_t maximum = 0;
    const auto magnitude = [](float r) { return std::bit_cast<std::int32_t>(r) & 0x7fffffff; };
    if (finest) {
        const std::uint8_t* weights = bytes_[colour] + at;
        Int16 ofLanes{};
        for (std::size_t m = 0; m < layout.half; m += 16) {
            const Float16 weight = __builtin_convertvector(widened(weights + m), Float16);
            const Float16 r = load<Float16>(f + m) - (p.sixteen(m) - weight * load<Float16>(own + m));
            const Int16 bits = weight > 0 ? std::bit_cast<Int16>(r) : Int16{};
            if constexpr (keep) store(out + m, load<Float16>(out + m) + std::bit_cast<Float16>(bits));
            const Int16 size = bits & 0x7fffffff;
            ofLanes = size > ofLanes ? size : ofLanes;
        }
        for (int lane = 0; lane < 16; ++lane) maximum = std::max(maximum, ofLanes[lane]);
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
            maximum = std::max(maximum, magnitude(r));
        }
    }
    return std::bit_cast<float>(maximum);
}

template float PoissonLevel::rowResidual<true>(int colour, int j, int k, float* out) const;  // poisson_transfer.cpp

float PoissonLevel::residual() const {
    std::atomic<float> maximum{0};
    forRows(layout, [&](int j, int k) {
        for (int colour = 0; colour < 2; ++colour) raiseTo(maximum, rowResidual<false>(colour, j, k, nullptr));
    });
    return maximum;
}

}  // namespace dustbench::grid_fluid::flow
