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

#include "methods/contract/errors.h"
#include "methods/grid_fluid/flow/density_balance.h"
#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/source_reach.h"
#include "methods/kit/memory/available_memory.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

const FluidSettings& checked(const FluidSettings& settings) {
    check(settings);
    // Checked for all memory at once, so that nothing is half allocated.
    const CellLayout layout(settings.box.cells);
    requireAvailable("grid of the fluid", layout.padded() * (2 * lanes * sizeof(float) + 1));
    // Sampling (sampling.h) uses 32-bit indices of floats.
    constexpr std::size_t maximumCells = std::numeric_limits<std::int32_t>::max() / lanes;
    if (layout.padded() > maximumCells)
        throw InputError("grid: got " + std::to_string(layout.padded()) +
                         " cells with their ghosts, allowed: " + std::to_string(maximumCells));
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
      advection_(layout_, ledger.account("fluid advection window")) {
    for (std::size_t at = 0; at < layout_.padded(); ++at)
        for (int axis = 0; axis < 3; ++axis) cells_.cell(at)[axis] = settings_.windMetresPerSecond[axis];
    (void)solids_.set({}, cells_);
}

std::size_t FluidSolver::floatsToLend() const {
    return std::max(pressure_.floatsNeeded(), forceFloats(layout_));
}

void FluidSolver::setSolids(const SolidMask& mask) {
    covered_ += solids_.set(mask, cells_);
    speedsKnown_ = false;
}

void FluidSolver::fill(GhostUse use) {
    fillGhosts(cells_, layout_, {settings_.sides, settings_.windMetresPerSecond, settings_.noSlip}, use);
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
        if (settings_.forces.confinementPerSecond > 0) fill(GhostUse::lookUp);
        applyForces(cells_, layout_, solids_.conductance(), settings_.forces, spacing, seconds, borrowed());
    }
    {
        const auto timing = clock.measureDetail("project");
        report.pressure = project(seconds);
    }
    ++steps_;
    lastStepSeconds_ = stepSeconds;
    findMaximumSpeeds();
    report.divergencePerStep = report.pressure.residual * seconds / spacing;
    report.cellsPerStep = std::max({maximumSpeeds_.x, maximumSpeeds_.y, maximumSpeeds_.z}) * seconds / spacing;
    return report;
}

void FluidSolver::advect(float seconds) {
    const float cellsPerSpeed = seconds / static_cast<float>(settings_.box.spacingMetres);
    const bool keeps = settings_.keepsDensity;
    const double due = keeps ? covered_ + densityTotal(cells_, layout_) -
                                   densityLeaving(cells_, layout_, solids_.conductance(), cellsPerSpeed)
                             : 0;
    solids_.extendInto(cells_, !settings_.noSlip);
    fill(GhostUse::lookUp);
    advection_.advect(cells_, spare_, solids_.conductance(), settings_.advection, cellsPerSpeed, maximumSpeeds_.z);
    cells_.swap(spare_);
    solids_.restore(cells_);
    if (keeps) scaleDensity(cells_, layout_, due);
    covered_ = 0;
}

PressureResult FluidSolver::project(float seconds) {
    fill(GhostUse::faces);
    pressure_.build(borrowed(), solids_.conductance());
    gatherDivergence(cells_, layout_, solids_.conductance(), pressure_.finest());
    const PressureRule rule{settings_.pressure, settings_.jacobiSweeps, settings_.maximumCycles,
                            settings_.divergencePerStep * static_cast<float>(settings_.box.spacingMetres) / seconds};
    const PressureResult result = pressure_.solve(rule);
    projection_.subtractGradient(cells_, layout_, solids_, pressure_.finest());
    return result;
}

void FluidSolver::addSources(std::span<const FluidSource> sources, float seconds) {
    const FluidBox& box = settings_.box;
    for (const FluidSource& source : sources) {
        const SourceReach reach = reachOf(source, box);
        const auto forFluidInReach = [&](const auto& take) {
            for (int k = reach.first.z; k <= reach.last.z; ++k)
                for (int j = reach.first.y; j <= reach.last.y; ++j)
                    for (int i = reach.first.x; i <= reach.last.x; ++i) {
                        const std::size_t at = layout_.at(i, j, k);
                        if (solids_.conductance()[at] != 1) continue;
                        const glm::vec3 d = glm::vec3(glm::dvec3(i, j, k) - reach.centreCells) * reach.perRadius;
                        take(cells_.cell(at), std::exp(-0.5f * (d.x * d.x + d.y * d.y + d.z * d.z)));
                    }
        };
        float added = source.densityPerSecond * seconds;
        if (source.amountM3PerSecond > 0) {
            double sum = 0;
            forFluidInReach([&](const float*, float strength) { sum += static_cast<double>(strength); });
            const double cell = box.spacingMetres * box.spacingMetres * box.spacingMetres;
            if (sum > 0)
                added += static_cast<float>(static_cast<double>(source.amountM3PerSecond * seconds) / (sum * cell));
        }
        const float taken = 1 - std::exp(-source.velocityPerSecond * seconds);
        forFluidInReach([&](float* record, float strength) {
            record[density] += strength * added;
            record[temperature] += strength * source.kelvinPerSecond * seconds;
            record[reaction] = std::max(record[reaction], strength * source.reaction);
            for (int axis = 0; axis < 3; ++axis)
                record[axis] += strength * taken * (source.velocityMetresPerSecond[axis] - record[axis]);
        });
    }
}

void FluidSolver::diffuseVelocity(float seconds) {
    const auto spacing = static_cast<float>(settings_.box.spacingMetres);
    const float diffusion = settings_.forces.viscosityM2PerSecond * seconds / (spacing * spacing);
    const int parts = diffusionParts(settings_, seconds);
    for (int part = 0; part < parts; ++part) {
        fill(GhostUse::lookUp);
        diffuse(cells_, layout_, solids_.conductance(), diffusion / static_cast<float>(parts), borrowed());
    }
}

void FluidSolver::findMaximumSpeeds() {
    // Eight records are three vectors; place p of these 48 floats is lane p mod 6.
    constexpr std::size_t vectors = 3, together = vectors * 16;
    using Places = std::array<Float16, vectors>;
    std::mutex mutex;
    std::array<float, lanes> maximum{};
    bool lost = false;
    parallel::forEachBlock(layout_.rows(), 128, [&](std::size_t first, std::size_t count) {
        Places ofBlock{}, zero{};
        const auto look = [&](const float* values) {
            for (std::size_t v = 0; v < vectors; ++v) {
                const auto value = load<Float16>(values + v * 16);
                ofBlock[v] = atLeast(ofBlock[v], value < 0 ? -value : value);
                zero[v] += value * 0.0f;  // not 0 if a value is not finite
            }
        };
        const std::size_t floats = static_cast<std::size_t>(layout_.nx) * lanes;
        for (std::size_t r = first; r < first + count; ++r) {
            const float* row = cells_.cell(layout_.at(0, layout_.rowJ(r), layout_.rowK(r)));
            std::size_t f = 0;
            for (; f + together <= floats; f += together) look(row + f);
            if (f == floats) continue;
            std::array<float, together> rest{};
            std::copy(row + f, row + floats, rest.begin());
            look(rest.data());
        }
        const std::scoped_lock lock(mutex);
        for (std::size_t p = 0; p < together; ++p) {
            maximum[p % lanes] = std::max(maximum[p % lanes], ofBlock[p / 16][p % 16]);
            lost |= !(zero[p / 16][p % 16] == 0);
        }
    });
    if (lost) throwLostNumber(cells_, layout_, steps_);
    for (int axis = 0; axis < 3; ++axis)
        maximumSpeeds_[axis] =
            std::max(maximum[static_cast<std::size_t>(axis)], std::fabs(settings_.windMetresPerSecond[axis]));
    speedsKnown_ = true;
}

void FluidSolver::scroll(glm::ivec3 by) {
    const std::array<int, 3> size{layout_.nx, layout_.ny, layout_.nz};
    parallel::forEachBlock(layout_.rows(), 16, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            const int j = layout_.rowJ(r), k = layout_.rowK(r);
            for (int i = 0; i < size[0]; ++i) {
                float* record = spare_.cell(layout_.at(i, j, k));
                const glm::ivec3 from = glm::ivec3(i, j, k) + by;
                const bool inside = from.x >= 0 && from.y >= 0 && from.z >= 0 && from.x < size[0] && from.y < size[1] &&
                                    from.z < size[2];
                if (inside) {
                    std::memcpy(record, cells_.cell(layout_.at(from.x, from.y, from.z)), lanes * sizeof(float));
                } else {
                    for (int axis = 0; axis < 3; ++axis) record[axis] = settings_.windMetresPerSecond[axis];
                    record[density] = record[temperature] = record[reaction] = 0;
                }
            }
        }
    });
    cells_.swap(spare_);
    settings_.box.originMetres += glm::dvec3(by) * settings_.box.spacingMetres;
    lastStepSeconds_ = 0;  // the memory of its pressure now holds the cells
    setSolids({});
}

void FluidSolver::gather(Lane lane, std::span<float> to) const {
    const auto width = static_cast<std::size_t>(layout_.nx);
    parallel::forEachBlock(layout_.rows(), 64, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            const float* record = cells_.cell(layout_.at(0, layout_.rowJ(r), layout_.rowK(r)));
            for (std::size_t i = 0; i < width; ++i) to[r * width + i] = record[i * lanes + lane];
        }
    });
}

void FluidSolver::gather(Lane, const gpu::Texture&) const {
    throw std::logic_error("a fluid that is solved on the CPU lies in no texture");
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
