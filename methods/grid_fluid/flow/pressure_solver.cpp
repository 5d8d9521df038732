#include "methods/grid_fluid/flow/pressure_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>

#include "methods/grid_fluid/flow/poisson_level.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// Disjoint sets (union-find); each is identified by its minimum member.
class Sets {
 public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
    [[nodiscard]] std::size_t of(std::size_t x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }
    void merge(std::size_t a, std::size_t b) {
        a = of(a), b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

 private:
    std::vector<std::size_t> parent_;
};

void findRuns(const std::uint8_t* row, int nx, int j, int k, std::vector<Run>& runs) {
    for (int i = 0; i < nx;) {
        if (row[i] != 1) {
            ++i;
            continue;
        }
        const void* solid = std::memchr(row + i, 0, static_cast<std::size_t>(nx - i));
        const int end = solid == nullptr ? nx : static_cast<int>(static_cast<const std::uint8_t*>(solid) - row);
        runs.push_back({i, end, j, k});
        i = end;
    }
}

constexpr std::size_t fewCells = 64;  ///< systems up to this size are solved exactly

/// The sweeps after one cycle, and those before the next.
constexpr std::array relaxationsBetween = [] {
    std::array<float, relaxationsAfter.size() + relaxationsBefore.size()> both{};
    std::ranges::copy(relaxationsBefore, std::ranges::copy(relaxationsAfter, both.begin()).out);
    return both;
}();

}  // namespace

std::vector<std::vector<Run>> closedRegions(const CellLayout& layout, const std::uint8_t* conductance) {
    std::vector<Run> runs;
    std::vector<std::size_t> firstOfRow(layout.rows() + 1);
    for (std::size_t r = 0; r < layout.rows(); ++r) {
        firstOfRow[r] = runs.size();
        const int j = layout.rowJ(r), k = layout.rowK(r);
        findRuns(conductance + layout.at(0, j, k), layout.nx, j, k, runs);
    }
    firstOfRow[layout.rows()] = runs.size();
    Sets sets(runs.size());
    const auto mergeRows = [&](std::size_t one, std::size_t other) {
        std::size_t a = firstOfRow[one], b = firstOfRow[other];
        while (a < firstOfRow[one + 1] && b < firstOfRow[other + 1]) {
            if (std::max(runs[a].i, runs[b].i) < std::min(runs[a].end, runs[b].end)) sets.merge(a, b);
            if (runs[a].end < runs[b].end)
                ++a;
            else
                ++b;
        }
    };
    const auto ny = static_cast<std::size_t>(layout.ny);
    for (std::size_t r = 0; r < layout.rows(); ++r) {
        if (r % ny != 0) mergeRows(r - 1, r);
        if (r >= ny) mergeRows(r - ny, r);
    }
    std::vector<bool> isOpen(runs.size(), false);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const Run& run = runs[r];
        const auto opens = [&](int i, int j, int k, std::size_t count) {
            return std::memchr(conductance + layout.at(i, j, k), 2, count) != nullptr;
        };
        const auto length = static_cast<std::size_t>(run.end - run.i);
        if ((run.i == 0 && opens(-1, run.j, run.k, 1)) || (run.end == layout.nx && opens(layout.nx, run.j, run.k, 1)) ||
            (run.j == 0 && opens(run.i, -1, run.k, length)) ||
            (run.j == layout.ny - 1 && opens(run.i, layout.ny, run.k, length)) ||
            (run.k == 0 && opens(run.i, run.j, -1, length)) ||
            (run.k == layout.nz - 1 && opens(run.i, run.j, layout.nz, length)))
            isOpen[sets.of(r)] = true;
    }
    std::map<std::size_t, std::vector<Run>> closedRuns;
    for (std::size_t r = 0; r < runs.size(); ++r)
        if (const std::size_t set = sets.of(r); !isOpen[set]) closedRuns[set].push_back(runs[r]);
    std::vector<std::vector<Run>> regions;
    regions.reserve(closedRuns.size());
    for (auto& [set, region] : closedRuns) regions.push_back(std::move(region));
    return regions;
}

void DenseSolver::factor(std::vector<double> matrix, std::size_t n) {
    lower_ = std::move(matrix);
    n_ = n;
    for (std::size_t c = 0; c < n; ++c) {
        const double original = lower_[c * n + c];
        double pivot = original;
        for (std::size_t k = 0; k < c; ++k) pivot -= lower_[c * n + k] * lower_[c * n + k] * lower_[k * n + k];
        const bool vanishes = !(pivot > 1e-7 * original);
        lower_[c * n + c] = vanishes ? 0 : pivot;
        for (std::size_t r = c + 1; r < n; ++r) {
            double sum = lower_[r * n + c];
            for (std::size_t k = 0; k < c; ++k) sum -= lower_[r * n + k] * lower_[c * n + k] * lower_[k * n + k];
            lower_[r * n + c] = vanishes ? 0 : sum / pivot;
        }
    }
}

void DenseSolver::solve(std::vector<double>& x) const {
    for (std::size_t r = 0; r < n_; ++r)
        for (std::size_t k = 0; k < r; ++k) x[r] -= lower_[r * n_ + k] * x[k];
    for (std::size_t r = 0; r < n_; ++r) x[r] = lower_[r * n_ + r] > 0 ? x[r] / lower_[r * n_ + r] : 0;
    for (std::size_t r = n_; r-- > 0;)
        for (std::size_t k = r + 1; k < n_; ++k) x[r] -= lower_[k * n_ + r] * x[k];
}

PressureSolver::PressureSolver(const CellLayout& layout, const Sides& sides) : layout_(layout) {
    for (std::size_t side = 0; side < 6; ++side) openSides_[side] = sides[side] == Side::open ? 1 : 0;
    Arena counting;
    layOut(counting);
    floatsNeeded_ = counting.used();
}

void PressureSolver::layOut(Arena& arena) {
    levels_.clear();
    glm::ivec3 cells(layout_.nx, layout_.ny, layout_.nz);
    levels_.push_back(std::make_unique<PoissonLevel>(cells, true, arena));
    other_ = arena.takeField(levels_.front()->layout);
    do {
        cells = (cells + 1) / 2;
        levels_.push_back(std::make_unique<PoissonLevel>(cells, false, arena));
    } while (levels_.back()->layout.cells() > fewCells);
}

void PressureSolver::build(std::span<float> memory, const std::uint8_t* conductance, bool sameSolids) {
    Arena arena(memory);
    layOut(arena);
    const auto buildLevels = [&] {
        levels_.front()->build(layout_, conductance);
        for (std::size_t level = 1; level < levels_.size(); ++level) levels_[level]->buildFrom(*levels_[level - 1]);
        if (!sameSolids) factorCoarsest();
    };
    const auto findClosedRegions = [&] {
        if (!sameSolids) closed_ = closedRegions(layout_, conductance);
    };
    parallel::forEachBlock(2, 1,
                           [&](std::size_t part, std::size_t) { part == 0 ? buildLevels() : findClosedRegions(); });
}

void PressureSolver::factorCoarsest() {
    const PoissonLevel& level = *levels_.back();
    const SplitLayout& at = level.layout;
    const std::size_t n = at.cells();
    std::vector<double> matrix(n * n, 0.0);
    const auto number = [&](int i, int j, int k) {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(at.ny) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(at.nx) +
               static_cast<std::size_t>(i);
    };
    for (int k = 0; k < at.nz; ++k)
        for (int j = 0; j < at.ny; ++j)
            for (int i = 0; i < at.nx; ++i) {
                const std::size_t own = number(i, j, k);
                // In double precision, so that in a closed region it is the sum of the other weights to within 1e-16.
                const auto weight = [&](int axis, int x, int y, int z) {
                    return static_cast<double>(level.face(axis, x, y, z));
                };
                matrix[own * n + own] = weight(0, i, j, k) + weight(0, i - 1, j, k) + weight(1, i, j, k) +
                                        weight(1, i, j - 1, k) + weight(2, i, j, k) + weight(2, i, j, k - 1);
                const auto couple = [&](int axis, std::size_t other) {
                    matrix[own * n + other] = matrix[other * n + own] = -weight(axis, i, j, k);
                };
                if (i + 1 < at.nx) couple(0, number(i + 1, j, k));
                if (j + 1 < at.ny) couple(1, number(i, j + 1, k));
                if (k + 1 < at.nz) couple(2, number(i, j, k + 1));
            }
    coarsest_.factor(std::move(matrix), n);
}

void PressureSolver::solveCoarsest() {
    PoissonLevel& level = *levels_.back();
    const SplitLayout& at = level.layout;
    std::vector<double> x;
    x.reserve(at.cells());
    for (int k = 0; k < at.nz; ++k)
        for (int j = 0; j < at.ny; ++j)
            for (int i = 0; i < at.nx; ++i) x.push_back(-static_cast<double>(level.rightSide.cell(at, i, j, k)));
    coarsest_.solve(x);
    level.clearPressure();
    auto value = x.begin();
    for (int k = 0; k < at.nz; ++k)
        for (int j = 0; j < at.ny; ++j)
            for (int i = 0; i < at.nx; ++i) level.pressure.cell(at, i, j, k) = static_cast<float>(*value++);
}

void PressureSolver::cycle(std::size_t number) {
    PoissonLevel& level = *levels_[number];
    if (number + 1 == levels_.size()) {
        solveCoarsest();
    } else {
        PoissonLevel& coarse = *levels_[number + 1];
        level.smooth({.fromZero = true, .relaxations = relaxationsBefore, .restriction = &coarse});
        cycle(number + 1);
        level.smooth({.correction = &coarse, .relaxations = relaxationsAfter});
    }
    level.fillNatural(openSides_);
}

float PressureSolver::balanceClosedRegions() {
    PoissonLevel& level = finest();
    float maximum = 0;
    for (const std::vector<Run>& region : closed_) {
        double sum = 0;
        std::int64_t cells = 0;
        for (const Run& run : region) {
            for (int i = run.i; i < run.end; ++i)
                sum += static_cast<double>(level.rightSide.cell(level.layout, i, run.j, run.k));
            cells += run.end - run.i;
        }
        const auto mean = static_cast<float>(sum / static_cast<double>(cells));
        maximum = std::max(maximum, std::fabs(mean));
        for (const Run& run : region)
            for (int i = run.i; i < run.end; ++i) level.rightSide.cell(level.layout, i, run.j, run.k) -= mean;
    }
    return maximum;
}

PressureResult PressureSolver::sweepJacobi(const PressureRule& rule) {
    PoissonLevel& level = finest();
    level.clearPressure();
    std::fill_n(other_.colour[0], level.layout.size(), 0.0f);
    std::fill_n(other_.colour[1], level.layout.size(), 0.0f);
    for (int sweep = 0; sweep < rule.jacobiSweeps; ++sweep) {
        level.jacobi(other_);
        std::swap(level.pressure, other_);
    }
    PressureResult result;
    result.cycles = rule.jacobiSweeps;
    result.residual = level.residual();
    return result;
}

PressureResult PressureSolver::solve(const PressureRule& rule) {
    PoissonLevel& level = finest();
    const float unremovable = closed_.empty() ? 0 : balanceClosedRegions();
    PressureResult result;
    if (rule.method == PressureMethod::jacobi) {
        result = sweepJacobi(rule);
    } else {
        // The sweeps after one cycle are those before the next: the restricted residual decides when to stop.
        PoissonLevel& coarse = *levels_[1];
        result.residual = level.smooth({.fromZero = true, .relaxations = relaxationsBefore, .restriction = &coarse});
        while (!(result.residual <= rule.tolerance) && result.cycles < rule.maximumCycles) {
            cycle(1);
            result.residual =
                level.smooth({.correction = &coarse, .relaxations = relaxationsBetween, .restriction = &coarse});
            ++result.cycles;
        }
    }
    result.unremovable = unremovable;
    return result;
}

}  // namespace dustbench::grid_fluid::flow
