#include "methods/grid_fluid/trail/fluid_trail.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "methods/grid_fluid/trail/dust_trail.h"

namespace dustbench::grid_fluid {
namespace {

/// Shares of all dust. A tile with less is dropped if it is also invisible; a cell with less does not enter the trail.
constexpr double leastOfTile = 1e-4, leastOfCell = 1e-10;
/// Maximum optical depth of a ray through an invisible tile: about one step of an 8-bit picture.
constexpr double unseenDepth = 5e-3;
/// Share of the maximum amount of dust so far, below which the dust counts as gone.
constexpr double nothing = 1e-9;

/// The ground keeps the trail from sinking or rising with the wind.
TrailSettings trailOf(const flow::FluidSettings& settings) {
    glm::vec3 wind = settings.windMetresPerSecond;
    wind.y = 0;
    return {settings.box.spacingMetres, wind, settings.forces.densityDecayPerSecond};
}

double cellM3Of(const flow::FluidBox& box) {
    return box.spacingMetres * box.spacingMetres * box.spacingMetres;
}

Cuboid cuboidOf(const flow::FluidBox& box, const glm::dvec3& firstCell, const glm::dvec3& endCell) {
    return {box.originMetres + firstCell * box.spacingMetres, box.originMetres + endCell * box.spacingMetres};
}

/// The current position of the dust that has just left.
Cuboid beyondFace(const flow::FluidBox& box, const flow::LeavingDensity& leaving) {
    glm::dvec3 first(leaving.cell), end = first + 1.0;
    const int axis = leaving.axis;
    const double reach = std::min(static_cast<double>(leaving.cells), 1.0);
    if (leaving.far) {
        first[axis] = end[axis];
        end[axis] += reach;
    } else {
        end[axis] = first[axis];
        first[axis] -= reach;
    }
    return cuboidOf(box, first, end);
}

}  // namespace

FluidTrail::FluidTrail(const flow::FluidSettings& settings, double extinctionPerMetre, MemoryLedger& ledger)
    : settings_(settings),
      dust_(trailOf(settings), ledger.account("fluid trail")),
      unseenDensity_(unseenDepth / std::max(extinctionPerMetre * settings.box.spacingMetres * DustTrail::edge, 1e-30)) {
}

void FluidTrail::leave(const flow::FluidBox& box, const glm::ivec3& by, std::span<const float> density) {
    const glm::ivec3 first = glm::clamp(by, glm::ivec3(0), box.cells);
    const glm::ivec3 end = box.cells + glm::clamp(by, -box.cells, glm::ivec3(0));
    const double cellM3 = cellM3Of(box), least = leastOfCell * dueM3_;
    std::size_t at = 0;
    for (int k = 0; k < box.cells.z; ++k)
        for (int j = 0; j < box.cells.y; ++j)
            for (int i = 0; i < box.cells.x; ++i, ++at) {
                const glm::ivec3 cell(i, j, k);
                if (glm::all(glm::greaterThanEqual(cell, first)) && glm::all(glm::lessThan(cell, end))) continue;
                const double amount = static_cast<double>(density[at]) * cellM3;
                if (amount > least) dust_.add(cuboidOf(box, cell, glm::dvec3(cell) + 1.0), amount);
            }
}

void FluidTrail::enter(flow::Solver& solver) {
    const flow::FluidBox& box = solver.box();
    const double cellM3 = cellM3Of(box);
    added_.clear();
    dust_.takeEntered(cuboidOf(box, glm::dvec3(0), glm::dvec3(box.cells)), [&](const glm::dvec3& middle,
                                                                               double amountM3) {
        const glm::dvec3 from = (middle - box.originMetres) / box.spacingMetres - 0.5;
        const Overlaps x(from.x, from.x + 1), y(from.y, from.y + 1), z(from.z, from.z + 1);
        for (int k = 0; k < z.count; ++k)
            for (int j = 0; j < y.count; ++j)
                for (int i = 0; i < x.count; ++i) {
                    // The part beyond the border goes to the cell within.
                    const glm::ivec3 cell(x.first + i, y.first + j, z.first + k);
                    const double share = x.shares[static_cast<std::size_t>(i)] * y.shares[static_cast<std::size_t>(j)] *
                                         z.shares[static_cast<std::size_t>(k)];
                    added_.push_back({glm::clamp(cell, glm::ivec3(0), box.cells - 1),
                                      static_cast<float>(amountM3 * share / cellM3)});
                }
    });
    if (added_.empty()) return;
    const auto order = [](const flow::AddedDensity& a) { return std::tuple(a.cell.z, a.cell.y, a.cell.x); };
    std::ranges::stable_sort(added_, {}, order);
    auto last = added_.begin();
    for (auto next = last + 1; next != added_.end(); ++next) {
        if (next->cell == last->cell)
            last->density += next->density;
        else
            *++last = *next;
    }
    added_.erase(last + 1, added_.end());
    solver.addDensity(added_);
}

void FluidTrail::pass(const flow::Solver& solver, float seconds, std::span<const flow::FluidSource> sources) {
    const double kept = static_cast<double>(std::exp(-settings_.forces.densityDecayPerSecond * seconds));
    for (const flow::FluidSource& source : sources)
        dueM3_ += static_cast<double>(source.amountM3PerSecond) * static_cast<double>(seconds);
    dueM3_ *= kept;
    maximumDueM3_ = std::max(maximumDueM3_, dueM3_);
    dust_.pass(seconds);
    const double cellM3 = cellM3Of(solver.box()), least = leastOfCell * dueM3_;
    for (const flow::LeavingDensity& leaving : solver.leaving()) {
        const double amount = static_cast<double>(leaving.density) * cellM3 * kept;
        if (amount > least) dust_.add(beyondFace(solver.box(), leaving), amount);
    }
    if (dueM3())
        dust_.settle(leastOfTile * dueM3_, unseenDensity_);
    else
        dust_.settle(std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
}

std::optional<double> FluidTrail::dueM3() const {
    return dueM3_ > nothing * maximumDueM3_ ? std::optional(dueM3_) : std::nullopt;
}

}  // namespace dustbench::grid_fluid
