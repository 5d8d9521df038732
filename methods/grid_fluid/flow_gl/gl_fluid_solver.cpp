#include "methods/grid_fluid/flow_gl/gl_fluid_solver.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "grid_fluid_flow_gl_shaders.h"
#include "methods/contract/errors.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

const flow::FluidSettings& checked(const flow::FluidSettings& settings, const gpu::Device& device) {
    flow::check(settings);
    const flow::CellLayout layout(settings.box.cells);
    const std::size_t padded = layout.padded();
    const std::size_t bytes = AdvectionOnGpu::largestBytes(layout, settings.advection),
                      maximum = device.maximumStorageBytes();
    const auto text = [&](const char* what, std::size_t got, std::size_t allowed) {
        const glm::ivec3& cells = settings.box.cells;
        return "grid of the fluid on the GPU: got " + std::to_string(cells.x) + "x" + std::to_string(cells.y) + "x" +
               std::to_string(cells.z) + " cells, " + std::to_string(got) + " bytes " + what +
               ", allowed: " + std::to_string(allowed);
    };
    if (bytes > maximum) throw InputError(text("in one buffer of OpenGL", bytes, maximum));
    // Per cell: three fields, its kind, and the pressure, which takes 16 bytes plus a quarter for the coarser levels.
    const std::size_t all = padded * (3 * (CellsOnGpu::bytesMoving + CellsOnGpu::bytesCarried) + 4 + 20) +
                            AdvectionOnGpu::allBytes(layout, settings.advection);
    if (const auto free = device.driverFreeBytes(); free && static_cast<std::int64_t>(all) > *free)
        throw InputError(text("in total", all, static_cast<std::size_t>(*free)));
    return settings;
}

}  // namespace

GlFluidSolver::GlFluidSolver(const flow::FluidSettings& settings, gpu::Device& device, MemoryLedger& ledger)
    : settings_(checked(settings, device)),
      layout_(settings.box.cells),
      ledger_(ledger),
      cells_(device, "fluid cells", layout_),
      spare_(device, "fluid cells of the last step", layout_),
      guess_(device, "fluid first guesses", layout_),
      report_(device, std::max(settings.maximumCycles, 0) + 1),
      solids_(device, layout_, settings.sides, ledger.account("fluid solids")),
      ghosts_(device, settings.box.cells, {settings.sides, settings.windMetresPerSecond, settings.noSlip}),
      advection_(device, layout_, settings.advection),
      sources_(device, settings.box.cells),
      forces_(device, settings.box.cells, settings.forces, static_cast<float>(settings.box.spacingMetres)),
      pressure_(device, settings.box.cells, settings.sides, settings.pressure),
      divergence_(device, {grid_glsl, level_glsl, kinds_glsl, divergence_comp}),
      gradient_(device, {grid_glsl, level_glsl, kinds_glsl, gradient_comp}),
      maximum_(device, {grid_glsl, maximum_comp}),
      scroll_(device, {grid_glsl, scroll_comp}),
      gather_(device, {grid_glsl, gather_comp}),
      gatherTexture_(device, {grid_glsl, gather_comp}, {{"TEXTURE", ""}}) {
    for (Kernel* kernel : {&divergence_, &gradient_, &maximum_, &scroll_, &gather_, &gatherTexture_})
        kernel->set("cells", settings.box.cells);
    scroll_.set("wind", settings.windMetresPerSecond);
    if (settings.keepsDensity) density_.emplace(device, settings.box.cells);
    if (settings.notesLeaving) exchange_.emplace(device, settings.box.cells);
    move(settings.box.cells);  // move by the whole box: only the wind remains
    ghosts_.setSideFaces(cells_);
}

void GlFluidSolver::setSolids(const flow::SolidMask& mask) {
    if (!solids_.set(mask) && !std::exchange(densityAdded_, false)) return;
    densityAdded_ = false;
    if (density_) density_->noteCovered(cells_, solids_.kinds());
    solids_.fill(cells_);
    operatorKnown_ = false;
    solidsChanged_ = true;
}

flow::StepReport GlFluidSolver::step(double stepSeconds, std::span<const flow::FluidSource> sources,
                                     const StageClock& clock) {
    flow::checkStep(stepSeconds);
    const auto seconds = static_cast<float>(stepSeconds);
    const auto spacing = static_cast<float>(settings_.box.spacingMetres);
    // Density that solids have covered since the last step still counts, as on the CPU.
    const bool solidsChanged = std::exchange(solidsChanged_, false);
    if (!speedsKnown_) report_.restartMaximum(settings_.windMetresPerSecond);
    if (!speedsKnown_ || solidsChanged) raiseMaximum();
    if (stateUnseen_) requireNumbers();
    {
        const auto timing = clock.measureDetail("advect");
        advect(seconds);
    }
    {
        const auto timing = clock.measureDetail("forces");
        sources_.add(cells_, solids_.kinds(), settings_.box, sources, seconds);
        diffuseVelocity(seconds);
        if (settings_.forces.confinementPerSecond > 0) ghosts_.fill(cells_);
        forces_.apply(cells_, guess_, spare_, solids_.kinds(), seconds);
    }
    {
        const auto timing = clock.measureDetail("project");
        project(seconds);
    }
    ++steps_;
    lastStepSeconds_ = stepSeconds;
    requireNumbers();
    if (exchange_) exchange_->readLeaving(leaving_);
    flow::StepReport report;
    report.pressure = pressure_.result();
    report.divergencePerStep = report.pressure.residual * seconds / spacing;
    report.cellsPerStep = std::max({report_.at(0), report_.at(1), report_.at(2)}) * seconds / spacing;
    return report;
}

void GlFluidSolver::advect(float seconds) {
    const float cellsPerSpeed = seconds / static_cast<float>(settings_.box.spacingMetres);
    if (density_) density_->noteDue(cells_, solids_.kinds(), cellsPerSpeed);
    if (exchange_) exchange_->noteLeaving(cells_, solids_.kinds(), cellsPerSpeed);
    solids_.extendInto(cells_, !settings_.noSlip);
    ghosts_.fill(cells_);
    const float ahead = flow::aheadOf(seconds, std::exchange(advectedSeconds_, seconds));
    advection_.advect(cells_, spare_, guess_, solids_.kinds(), report_, cellsPerSpeed, ahead);
    ghosts_.setSideFaces(cells_);
    solids_.fill(cells_);
    if (density_) density_->restore(cells_, solids_.kinds());
}

void GlFluidSolver::diffuseVelocity(float seconds) {
    const auto spacing = static_cast<float>(settings_.box.spacingMetres);
    const float diffusion = settings_.forces.viscosityM2PerSecond * seconds / (spacing * spacing);
    const int parts = flow::diffusionParts(settings_, seconds);
    for (int part = 0; part < parts; ++part) {
        ghosts_.fill(cells_);
        forces_.diffuse(cells_, spare_, solids_.kinds(), diffusion / static_cast<float>(parts));
        std::swap(cells_.moving, spare_.moving);
    }
}

void GlFluidSolver::project(float seconds) {
    const gpu::Buffer& kinds = solids_.kinds();
    if (!operatorKnown_) pressure_.build(kinds, solids_.closedRegions());
    operatorKnown_ = true;
    ghosts_.setSideFaces(cells_);
    gatherDivergence();
    report_.restart();
    pressure_.start({settings_.pressure, settings_.jacobiSweeps, settings_.maximumCycles,
                     settings_.divergencePerStep * static_cast<float>(settings_.box.spacingMetres) / seconds},
                    report_);
    // The gradient is written to another field, so that it can be recomputed if the pressure was not accurate enough.
    do {
        kinds.bindStorage(0);
        cells_.moving.bindStorage(1);
        spare_.moving.bindStorage(2);
        pressure_.pressure().bindStorage(5);
        gradient_.run(settings_.box.cells + 1);
        std::swap(cells_.moving, spare_.moving);
        report_.restartMaximum(settings_.windMetresPerSecond);
        raiseMaximum();
        std::swap(cells_.moving, spare_.moving);
        report_.read();
    } while (!pressure_.enough(report_));
    std::swap(cells_.moving, spare_.moving);
}

void GlFluidSolver::gatherDivergence() const {
    solids_.kinds().bindStorage(0);
    cells_.moving.bindStorage(1);
    pressure_.rightSide().bindStorage(4);
    divergence_.run(settings_.box.cells);
}

float GlFluidSolver::divergencePerStep() const {
    gatherDivergence();
    std::vector<float> values(pressure_.rightSide().bytes() / sizeof(float));
    pressure_.rightSide().read(std::span<float>(values));
    float maximum = 0;
    for (const float value : values) maximum = std::max(maximum, std::fabs(value));
    return maximum * static_cast<float>(lastStepSeconds_ / settings_.box.spacingMetres);
}

void GlFluidSolver::raiseMaximum() {
    cells_.bind(1);
    report_.bind();
    maximum_.run(Kernel::columnsOf(settings_.box.cells));
    speedsKnown_ = true;
}

void GlFluidSolver::requireNumbers() {
    if (std::exchange(stateUnseen_, false)) report_.read();
    if (!report_.anyNumberLost()) return;
    flow::CellField state(layout_, ledger_.account("fluid cells to look into"));
    readCells(state);
    flow::throwLostNumber(state, layout_, steps_);
}

void GlFluidSolver::move(const glm::ivec3& by) {
    cells_.bind(1);
    spare_.bind(3);
    scroll_.set("by", by);
    scroll_.run(settings_.box.cells + 1);
    std::swap(cells_, spare_);
}

void GlFluidSolver::scroll(glm::ivec3 by) {
    move(by);
    advection_.scroll(by, settings_.windMetresPerSecond, spare_);
    settings_.box.originMetres += glm::dvec3(by) * settings_.box.spacingMetres;
    lastStepSeconds_ = 0;  // the pressure belongs to the cells before the move
    setSolids({});
}

void GlFluidSolver::addDensity(std::span<const flow::AddedDensity> added) {
    if (added.empty()) return;
    exchange_->add(cells_, added);
    densityAdded_ = true;
}

void GlFluidSolver::writeCells(const flow::CellField& state) {
    std::vector<glm::vec4> moving(layout_.padded());
    std::vector<glm::vec2> carried(layout_.padded());
    for (std::size_t at = 0; at < layout_.padded(); ++at) {
        const float* record = state.cell(at);
        moving[at] = {record[0], record[1], record[2], record[flow::density]};
        carried[at] = {record[flow::temperature], record[flow::reaction]};
    }
    cells_.moving.write(std::span<const glm::vec4>(moving));
    cells_.carried.write(std::span<const glm::vec2>(carried));
    speedsKnown_ = false;
    advectedSeconds_ = 0;
    stateUnseen_ = true;
}

void GlFluidSolver::readCells(flow::CellField& state) const {
    std::vector<glm::vec4> moving(layout_.padded());
    std::vector<glm::vec2> carried(layout_.padded());
    cells_.moving.read(std::span<glm::vec4>(moving));
    cells_.carried.read(std::span<glm::vec2>(carried));
    for (std::size_t at = 0; at < layout_.padded(); ++at) {
        float* record = state.cell(at);
        for (int lane = 0; lane < 4; ++lane) record[lane] = moving[at][lane];
        record[flow::temperature] = carried[at].x;
        record[flow::reaction] = carried[at].y;
    }
}

void GlFluidSolver::gather(flow::Lane lane, std::span<float> to) const {
    gather(lane, false, to);
}

void GlFluidSolver::gatherStored(flow::Lane lane, std::span<float> to) const {
    gather(lane, true, to);
}

void GlFluidSolver::gather(flow::Lane lane, bool asStored, std::span<float> to) const {
    // First guesses are used within a step only.
    cells_.bind(1);
    guess_.moving.bindStorage(3);
    gather_.set("lane", static_cast<int>(lane));
    gather_.set("asStored", asStored ? 1 : 0);
    gather_.run(settings_.box.cells);
    guess_.moving.read(to);
}

void GlFluidSolver::gather(flow::Lane lane, const gpu::Texture& to) const {
    cells_.bind(1);
    to.bindImage(0, false, true);
    gatherTexture_.set("lane", static_cast<int>(lane));
    gatherTexture_.run(settings_.box.cells);
}

std::vector<float> GlFluidSolver::pressuresM2PerS2() const {
    if (lastStepSeconds_ == 0) return std::vector<float>(settings_.box.cellCount(), 0.0f);
    std::vector<float> values = pressure_.readPressure();
    const auto scale = static_cast<float>(settings_.box.spacingMetres / lastStepSeconds_);
    for (float& value : values) value *= scale;
    return values;
}

std::uint64_t GlFluidSolver::stateHash() const {
    MemoryLedger passing;
    flow::CellField state(layout_, passing.account("state"));
    readCells(state);
    return flow::hashOf(state, layout_);
}

MemoryReport GlFluidSolver::gpuMemory() const {
    return {{"fluid cells", 0, cells_.bytes()},
            {"fluid cells of the last step", 0, spare_.bytes()},
            {"fluid first guesses", 0, guess_.bytes()},
            {"fluid paths", 0, advection_.bytes()},
            {"fluid solids", 0, solids_.bytes()},
            {"fluid density", 0, density_ ? density_->bytes() : 0},
            {"fluid exchange", 0, exchange_ ? exchange_->bytes() : 0},
            {"fluid sources", 0, sources_.bytes()},
            {"fluid pressure", 0, pressure_.bytes()}};
}

}  // namespace dustbench::grid_fluid::flow_gl
