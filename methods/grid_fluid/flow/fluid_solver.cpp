#include "methods/grid_fluid/flow/fluid_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "methods/contract/errors.h"
#include "methods/grid_fluid/flow/density_balance.h"
#include "methods/grid_fluid/flow/fluid_source.h"
#include "methods/grid_fluid/flow/lanes.h"
#include "methods/kit/memory/available_memory.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

const FluidSettings& checked(const FluidSettings& settings) {
    check(settings);
    // Checked for all memory at once, so that nothing is half allocated.
    const CellLayout layout(settings.box.cells);
    const std::size_t velocities = settings.advection.velocityAt == VelocityAt::middle ? 3 * sizeof(float) : 0;
    requireAvailable("grid of the fluid", layout.padded() * (2 * lanes * sizeof(float) + 1 + velocities));
    // Sampling (sampling.h) uses 32-bit indices of floats.
    constexpr std::size_t maximumPaddedCells = std::numeric_limits<std::int32_t>::max() / lanes;
    if (layout.padded() > maximumPaddedCells)
        throw InputError("grid: got " + std::to_string(layout.padded()) +
                         " cells with their ghosts, allowed: " + std::to_string(maximumPaddedCells));
    return settings;
}

}  // namespace

FluidSolver::FluidSolver(const FluidSettings& settings, MemoryLedger& ledger)
    : settings_(checked(settings)),
      layout_(settings.box.cells),
      pressure_(layout_, settings.sides),
      cells_(layout_, ledger.account("fluid cells"), floatsToLend()),
      spare_(layout_, ledger.account("fluid cells of the last step"), floatsToLend()),
      solids_(layout_, settings.sides, ledger.account("fluid solids")),
      advection_(layout_, ledger.account("fluid advection")) {
    for (std::size_t at = 0; at < layout_.padded(); ++at)
        for (int axis = 0; axis < 3; ++axis) cells_.cell(at)[axis] = settings_.windMetresPerSecond[axis];
    setSideFaces(cells_, layout_, ghostRule());
    (void)solids_.set({}, cells_);
}

std::size_t FluidSolver::floatsToLend() const {
    return std::max(pressure_.floatsNeeded(), forceFloats(layout_));
}

void FluidSolver::setSolids(const SolidMask& mask) {
    const SolidCells::Change change = solids_.set(mask, cells_);
    sameSolids_ = false;
    covered_ += change.coveredDensity;
    maximumSpeeds_ = glm::max(maximumSpeeds_, change.maximumSpeeds);
}

StepReport FluidSolver::step(double stepSeconds, std::span<const FluidSource> sources, const StageClock& clock) {
    checkStep(stepSeconds);
    if (!speedsKnown_) findMaximumSpeeds();
    const auto seconds = static_cast<float>(stepSeconds);
    const auto spacing = static_cast<float>(settings_.box.spacingMetres);
    StepReport report;
    {
        const auto timing = clock.measureDetail("advect");
        advect(seconds);
    }
    {
        const auto timing = clock.measureDetail("forces");
        addSources(sources, seconds);
        diffuseVelocity(seconds);
        if (settings_.forces.confinementPerSecond > 0) fillGhosts();
        applyForces(cells_, layout_, solids_.conductance(), solids_.moving(), settings_.forces, spacing, seconds,
                    borrowed());
    }
    {
        const auto timing = clock.measureDetail("project");
        ++steps_;
        lastStepSeconds_ = stepSeconds;
        report.pressure = project(seconds);
    }
    report.divergencePerStep = report.pressure.residual * seconds / spacing;
    report.cellsPerStep = std::max({maximumSpeeds_.x, maximumSpeeds_.y, maximumSpeeds_.z}) * seconds / spacing;
    return report;
}

void FluidSolver::advect(float seconds) {
    const float cellsPerSpeed = seconds / static_cast<float>(settings_.box.spacingMetres);
    const bool keeps = settings_.keepsDensity, notes = settings_.notesLeaving;
    leaving_.clear();
    double due = keeps ? covered_ + densityTotal(cells_, layout_) : 0;
    if (keeps || notes)
        due -= densityLeaving(cells_, layout_, solids_.conductance(), cellsPerSpeed, notes ? &leaving_ : nullptr);
    solids_.extendInto(cells_, !settings_.noSlip);
    fillGhosts();
    const float ahead = aheadOf(seconds, std::exchange(advectedSeconds_, seconds));
    advection_.advect(cells_, spare_, solids_.moving(), settings_.advection, {cellsPerSpeed, maximumSpeeds_, ahead});
    setSideFaces(cells_, layout_, ghostRule());
    solids_.restore(cells_);
    if (keeps) scaleDensity(cells_, layout_, due);
    covered_ = 0;
}

PressureResult FluidSolver::project(float seconds) {
    setSideFaces(cells_, layout_, ghostRule());
    pressure_.build(borrowed(), solids_.conductance(), sameSolids_);
    sameSolids_ = true;
    gatherDivergence(cells_, layout_, solids_.conductance(), pressure_.finest());
    const PressureRule rule{settings_.pressure, settings_.jacobiSweeps, settings_.maximumCycles,
                            settings_.divergencePerStep * static_cast<float>(settings_.box.spacingMetres) / seconds};
    const PressureResult result = pressure_.solve(rule);
    note(subtractGradient(cells_, layout_, solids_.conductance(), pressure_.finest()));
    return result;
}

void FluidSolver::addSources(std::span<const FluidSource> sources, float seconds) {
    const FluidBox& box = settings_.box;
    for (const FluidSource& source : sources) {
        const SourceReach reach = reachOf(source, box);
        const auto strengthAt = [&](const glm::vec3& place) {
            const glm::vec3 d = (place - glm::vec3(reach.centreCells)) * reach.perRadius;
            return std::exp(-0.5f * glm::dot(d, d));
        };
        const auto forCellsOfSlab = [&](int k, const auto& take) {
            for (int j = reach.first.y; j <= reach.last.y; ++j)
                for (int i = reach.first.x; i <= reach.last.x; ++i) {
                    const std::size_t at = layout_.at(i, j, k);
                    take(cells_.cell(at), solids_.moving()[at], glm::vec3(i, j, k));
                }
        };
        float added = source.densityPerSecond * seconds;
        if (source.amountM3PerSecond > 0) {
            double sum = 0;
            for (int k = reach.first.z; k <= reach.last.z; ++k)
                forCellsOfSlab(k, [&](const float*, Moving moving, const glm::vec3& place) {
                    if ((moving & 8) != 0) sum += static_cast<double>(strengthAt(place));
                });
            const double cell = box.spacingMetres * box.spacingMetres * box.spacingMetres;
            if (sum > 0)
                added += static_cast<float>(static_cast<double>(source.amountM3PerSecond * seconds) / (sum * cell));
        }
        const float taken = 1 - std::exp(-source.velocityPerSecond * seconds);
        const auto takeIn = [&](float* record, Moving moving, const glm::vec3& place) {
            if ((moving & 8) != 0) {
                const float strength = strengthAt(place);
                record[density] += strength * added;
                record[temperature] += strength * source.kelvinPerSecond * seconds;
                record[reaction] = std::max(record[reaction], strength * source.reaction);
            }
            if (taken == 0) return;
            for (int axis = 0; axis < 3; ++axis) {
                if ((moving >> axis & 1) == 0) continue;
                glm::vec3 face = place;
                face[axis] -= 0.5f;
                record[axis] += strengthAt(face) * taken * (source.velocityMetresPerSecond[axis] - record[axis]);
            }
        };
        const auto slabs = static_cast<std::size_t>(std::max(reach.last.z - reach.first.z + 1, 0));
        parallel::forEachBlock(slabs, 1, [&](std::size_t slab, std::size_t) {
            forCellsOfSlab(reach.first.z + static_cast<int>(slab), takeIn);
        });
    }
}

void FluidSolver::diffuseVelocity(float seconds) {
    const auto spacing = static_cast<float>(settings_.box.spacingMetres);
    const float diffusion = settings_.forces.viscosityM2PerSecond * seconds / (spacing * spacing);
    const int parts = diffusionParts(settings_, seconds);
    for (int part = 0; part < parts; ++part) {
        fillGhosts();
        diffuse(cells_, layout_, solids_.moving(), diffusion / static_cast<float>(parts), borrowed());
    }
}

void FluidSolver::findMaximumSpeeds() {
    std::mutex mutex;
    FieldSurvey survey;
    parallel::forEachBlock(layout_.rows(), 128, [&](std::size_t first, std::size_t count) {
        FieldSurvey ofBlock;
        for (std::size_t r = first; r < first + count; ++r)
            ofBlock.look(cells_.cell(layout_.at(0, layout_.rowJ(r), layout_.rowK(r))),
                         static_cast<std::size_t>(layout_.nx));
        const std::scoped_lock lock(mutex);
        survey.add(ofBlock);
    });
    note(survey);
}

void FluidSolver::note(const FieldSurvey& survey) {
    if (!survey.finite()) throwLostNumber(cells_, layout_, steps_);
    const auto maxima = survey.maxima();
    for (int axis = 0; axis < 3; ++axis)
        maximumSpeeds_[axis] =
            std::max(maxima[static_cast<std::size_t>(axis)], std::fabs(settings_.windMetresPerSecond[axis]));
    speedsKnown_ = true;
}

void FluidSolver::scroll(glm::ivec3 by) {
    const glm::ivec3 size(layout_.nx, layout_.ny, layout_.nz);
    // With the records behind the last cells, which hold the faces of the far sides.
    parallel::forEachBlock(static_cast<std::size_t>(size.z) + 1, 1, [&](std::size_t slab, std::size_t) {
        for (glm::ivec3 cell(0, 0, static_cast<int>(slab)); cell.y <= size.y; ++cell.y)
            for (cell.x = 0; cell.x <= size.x; ++cell.x) {
                float* record = spare_.cell(layout_.at(cell.x, cell.y, cell.z));
                const glm::ivec3 from = cell + by;
                const auto had = [&](int farAxis) {  // the records behind the last cells hold faces of one axis each
                    glm::ivec3 end = size;
                    if (farAxis >= 0) end[farAxis] += 1;
                    return glm::all(glm::greaterThanEqual(from, glm::ivec3(0))) && glm::all(glm::lessThan(from, end));
                };
                const glm::ivec3 inside = glm::clamp(from, glm::ivec3(0), size);
                const float* old = cells_.cell(layout_.at(inside.x, inside.y, inside.z));
                for (int axis = 0; axis < 3; ++axis)
                    record[axis] = had(axis) ? old[axis] : settings_.windMetresPerSecond[axis];
                for (std::size_t lane = density; lane < lanes; ++lane) record[lane] = had(-1) ? old[lane] : 0;
            }
    });
    cells_.swap(spare_);
    advection_.scroll(by, settings_.windMetresPerSecond);
    settings_.box.originMetres += glm::dvec3(by) * settings_.box.spacingMetres;
    lastStepSeconds_ = 0;  // the memory of its pressure now holds the cells
    setSolids({});
}

void FluidSolver::addDensity(std::span<const AddedDensity> added) {
    for (const auto& [cell, more] : added) cells_.cell(layout_.at(cell.x, cell.y, cell.z))[density] += more;
}

void FluidSolver::gather(Lane lane, std::span<float> to) const {
    gatherMean(lane, lane > velocityZ ? 0 : std::array{std::size_t{1}, layout_.row, layout_.slab}[lane], to);
}

void FluidSolver::gatherStored(Lane lane, std::span<float> to) const {
    gatherMean(lane, 0, to);
}

/// Of each record and the one `next` behind it.
void FluidSolver::gatherMean(Lane lane, std::size_t next, std::span<float> to) const {
    const auto width = static_cast<std::size_t>(layout_.nx);
    parallel::forEachBlock(layout_.rows(), 64, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            const float* record = cells_.cell(layout_.at(0, layout_.rowJ(r), layout_.rowK(r)));
            for (std::size_t i = 0; i < width; ++i)
                to[r * width + i] = 0.5f * (record[i * lanes + lane] + record[(i + next) * lanes + lane]);
        }
    });
}

float FluidSolver::divergencePerStep() const {
    return maximumDivergence(cells_, layout_, solids_.conductance()) *
           static_cast<float>(lastStepSeconds_ / settings_.box.spacingMetres);
}

void FluidSolver::gather(Lane, const gpu::Texture&) const {
    throw std::logic_error("a fluid that is solved on the CPU has no textures");
}

std::vector<float> FluidSolver::pressuresM2PerS2() const {
    std::vector<float> pressures(settings_.box.cellCount(), 0.0f);
    const PoissonLevel& level = pressure_.finest();
    if (lastStepSeconds_ == 0 || level.pressure.colour[0] == nullptr) return pressures;
    const auto scale = static_cast<float>(settings_.box.spacingMetres / lastStepSeconds_);
    auto pressure = pressures.begin();
    for (std::size_t r = 0; r < layout_.rows(); ++r)
        for (int i = 0; i < layout_.nx; ++i)
            *pressure++ = level.pressure.cell(level.layout, i, layout_.rowJ(r), layout_.rowK(r)) * scale;
    return pressures;
}

std::uint64_t FluidSolver::stateHash() const {
    return hashOf(cells_, layout_);
}

}  // namespace dustbench::grid_fluid::flow
