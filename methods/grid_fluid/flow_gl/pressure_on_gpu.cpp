#include "methods/grid_fluid/flow_gl/pressure_on_gpu.h"

#include <algorithm>
#include <array>
#include <utility>

#include "grid_fluid_flow_gl_shaders.h"
#include "methods/grid_fluid/flow/poisson_level.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

constexpr int fewCells = 32;  ///< systems up to this size are solved exactly

/// Bindings, as in the shaders.
enum : std::uint32_t { kindsAt, pressureAt, targetAt, operationAt, rightSideAt, extraAt, regionsAt };

int count(const glm::ivec3& cells) {
    return cells.x * cells.y * cells.z;
}

/// Size of a level, both colours and ghosts, as in level.glsl.
std::size_t places(const glm::ivec3& cells) {
    return 2 * static_cast<std::size_t>((cells.x + 3) / 2) * static_cast<std::size_t>(cells.y + 2) *
           static_cast<std::size_t>(cells.z + 2);
}

/// Cells of one colour: half as many along x.
glm::ivec3 ofOneColour(const glm::ivec3& cells) {
    return {(cells.x + 1) / 2, cells.y, cells.z};
}

std::map<std::string, std::string> finest() {
    return {{"FINEST", ""}};
}

}  // namespace

PressureOnGpu::PressureOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::Sides& sides,
                             flow::PressureMethod method)
    : diagonal_(device, {grid_glsl, level_glsl, kinds_glsl, diagonal_comp}),
      coarsen_{{device, {grid_glsl, level_glsl, kinds_glsl, coarsen_comp}, finest()},
               {device, {grid_glsl, level_glsl, coarsen_comp}}},
      sweep_{{device, {grid_glsl, level_glsl, neighbours_glsl, sweep_comp}, finest()},
             {device, {grid_glsl, level_glsl, neighbours_glsl, sweep_comp}}},
      restrict_{{device, {grid_glsl, level_glsl, neighbours_glsl, residual_glsl, restrict_comp}, finest()},
                {device, {grid_glsl, level_glsl, neighbours_glsl, residual_glsl, restrict_comp}}},
      prolong_{{device, {grid_glsl, level_glsl, prolong_comp}, finest()},
               {device, {grid_glsl, level_glsl, prolong_comp}}},
      residual_(device, {grid_glsl, level_glsl, neighbours_glsl, residual_glsl, residual_comp}, finest()),
      widen_(device, {grid_glsl, level_glsl, widen_comp}, {{"SIDES", sidesText(sides)}}),
      invert_(device, {grid_glsl, level_glsl, coarsest_invert_comp}, {{"MOST_CELLS", std::to_string(fewCells)}}),
      solve_(device, {grid_glsl, level_glsl, coarsest_solve_comp}, {{"MOST_CELLS", std::to_string(fewCells)}}),
      closed_(device, {grid_glsl, level_glsl, closed_comp}),
      device_(device) {
    addLevel(device, cells);
    if (method == flow::PressureMethod::jacobi) {
        other_ = gpu::Buffer(device, "fluid pressure", levels_.front().pressure.bytes());
        other_.clear();
        return;
    }
    do {
        addLevel(device, (levels_.back().cells + 1) / 2);
    } while (count(levels_.back().cells) > fewCells);
    inverse_ = gpu::Buffer(device, "fluid pressure", fewCells * fewCells * sizeof(float));
}

void PressureOnGpu::addLevel(gpu::Device& device, const glm::ivec3& cells) {
    const bool isFinest = levels_.empty();
    const std::size_t size = places(cells) * sizeof(float);
    Level level;
    level.cells = cells;
    level.pressure = gpu::Buffer(device, "fluid pressure", size);
    level.rightSide = gpu::Buffer(device, "fluid pressure", size);
    level.operation = gpu::Buffer(device, "fluid pressure", isFinest ? size : 4 * size);
    if (!isFinest) level.wide = gpu::Buffer(device, "fluid pressure", flow::CellLayout(cells).padded() * sizeof(float));
    for (gpu::Buffer* buffer : {&level.pressure, &level.rightSide, &level.operation}) buffer->clear();
    levels_.push_back(std::move(level));
}

void PressureOnGpu::bind(const Level& level) const {
    level.pressure.bindStorage(pressureAt);
    level.operation.bindStorage(operationAt);
    level.rightSide.bindStorage(rightSideAt);
}

void PressureOnGpu::build(const gpu::Buffer& kinds, const std::vector<std::vector<flow::Run>>& closed) {
    kinds.bindStorage(kindsAt);
    levels_.front().operation.bindStorage(operationAt);
    diagonal_.set("cells", levels_.front().cells);
    diagonal_.run(levels_.front().cells);
    for (std::size_t l = 1; l < levels_.size(); ++l) {
        const Level &fine = levels_[l - 1], &level = levels_[l];
        Kernel& coarsen = coarsen_.of(l - 1);
        fine.operation.bindStorage(pressureAt);
        level.operation.bindStorage(operationAt);
        coarsen.set("cells", level.cells);
        coarsen.set("fine", fine.cells);
        coarsen.run(level.cells + 1);
    }
    if (levels_.size() > 1) {
        levels_.back().operation.bindStorage(operationAt);
        inverse_.bindStorage(extraAt);
        invert_.set("cells", levels_.back().cells);
        invert_.runGroups(1);
    }
    std::vector<glm::ivec4> runs;
    std::vector<glm::ivec2> regions;
    for (const std::vector<flow::Run>& region : closed) {
        const auto first = static_cast<int>(runs.size());
        for (const flow::Run& run : region) runs.emplace_back(run.i, run.end, run.j, run.k);
        regions.emplace_back(first, static_cast<int>(runs.size()));
    }
    regionCount_ = static_cast<int>(regions.size());
    if (regions.empty()) return;
    runs_ = gpu::Buffer(device_, "fluid closed regions", std::span<const glm::ivec4>(runs));
    regions_ = gpu::Buffer(device_, "fluid closed regions", std::span<const glm::ivec2>(regions));
}

void PressureOnGpu::smooth(std::size_t number, std::span<const float> relaxations) {
    const Level& level = levels_[number];
    bind(level);
    level.pressure.bindStorage(targetAt);
    Kernel& sweep = sweep_.of(number);
    sweep.set("cells", level.cells);
    for (const float relaxation : relaxations)
        for (int colour = 0; colour < 2; ++colour) {
            sweep.set("colour", colour);
            sweep.set("relaxation", colour == 1 ? relaxation : 1.0f);
            sweep.run(ofOneColour(level.cells));
        }
}

void PressureOnGpu::restrictFrom(std::size_t number, int slot) {
    const Level &level = levels_[number], &coarse = levels_[number + 1];
    bind(level);
    coarse.rightSide.bindStorage(extraAt);
    Kernel& kernel = restrict_.of(number);
    kernel.set("cells", level.cells);
    kernel.set("coarse", coarse.cells);
    if (number == 0) kernel.set("slot", slot);
    kernel.run(coarse.cells);
}

void PressureOnGpu::correctFrom(std::size_t number) {
    cycle(number);
    const Level &coarse = levels_[number], &level = levels_[number - 1];
    bind(coarse);
    coarse.wide.bindStorage(targetAt);
    widen_.set("cells", coarse.cells);
    widen_.run(coarse.cells + 2);
    bind(level);
    Kernel& prolong = prolong_.of(number - 1);
    prolong.set("cells", level.cells);
    prolong.set("coarse", coarse.cells);
    prolong.set("times", flow::overcorrection);
    prolong.run(ofOneColour(level.cells));
}

void PressureOnGpu::cycle(std::size_t number) {
    if (number + 1 == levels_.size()) return solveCoarsest();
    levels_[number].pressure.clear();
    smooth(number, flow::relaxationsBefore);
    restrictFrom(number, 0);
    correctFrom(number + 1);
    smooth(number, flow::relaxationsAfter);
}

void PressureOnGpu::solveCoarsest() {
    const Level& level = levels_.back();
    bind(level);
    inverse_.bindStorage(extraAt);
    solve_.set("cells", level.cells);
    solve_.runGroups(1);
}

void PressureOnGpu::balanceClosedRegions() {
    if (regionCount_ == 0) return;
    bind(levels_.front());
    runs_.bindStorage(extraAt);
    regions_.bindStorage(regionsAt);
    closed_.set("cells", levels_.front().cells);
    closed_.set("slot", StepReportOnGpu::unremovable);
    closed_.set("regionCount", regionCount_);
    closed_.runGroups(regionCount_);
}

void PressureOnGpu::sweepJacobi() {
    Level& level = levels_.front();
    sweep_.finest.set("cells", level.cells);
    sweep_.finest.set("relaxation", 1.0f);
    for (int sweep = 0; sweep < rule_.jacobiSweeps; ++sweep) {
        bind(level);
        other_.bindStorage(targetAt);
        for (int colour = 0; colour < 2; ++colour) {
            sweep_.finest.set("colour", colour);
            sweep_.finest.run(ofOneColour(level.cells));
        }
        std::swap(level.pressure, other_);
    }
    bind(level);
    residual_.set("cells", level.cells);
    residual_.set("slot", StepReportOnGpu::firstResidual);
    residual_.run(level.cells);
}

void PressureOnGpu::queueCycle() {
    correctFrom(1);
    smooth(0, flow::relaxationsAfter);
    smooth(0, flow::relaxationsBefore);
    restrictFrom(0, StepReportOnGpu::firstResidual + ++cycles_);
}

void PressureOnGpu::start(const flow::PressureRule& rule, StepReportOnGpu& report) {
    rule_ = rule;
    cycles_ = 0;
    report.bind();
    balanceClosedRegions();
    levels_.front().pressure.clear();
    if (rule.method == flow::PressureMethod::jacobi) return sweepJacobi();
    // The sweeps after one cycle are those before the next: the restricted residual decides when to stop.
    smooth(0, flow::relaxationsBefore);
    restrictFrom(0, StepReportOnGpu::firstResidual);
    while (cycles_ < std::min(expectedCycles_, rule.maximumCycles)) queueCycle();
}

bool PressureOnGpu::enough(StepReportOnGpu& report) {
    const auto residualAfter = [&](int cycles) { return report.at(StepReportOnGpu::firstResidual + cycles); };
    result_.unremovable = report.at(StepReportOnGpu::unremovable);
    result_.residual = residualAfter(cycles_);
    result_.cycles = rule_.method == flow::PressureMethod::jacobi ? rule_.jacobiSweeps : cycles_;
    if (rule_.method == flow::PressureMethod::jacobi) return true;
    if (!(result_.residual <= rule_.tolerance) && cycles_ < rule_.maximumCycles) {
        report.bind();
        queueCycle();
        return false;
    }
    expectedCycles_ = 0;
    while (expectedCycles_ < cycles_ && !(residualAfter(expectedCycles_) <= rule_.tolerance)) ++expectedCycles_;
    return true;
}

std::vector<float> PressureOnGpu::readPressure() const {
    const glm::ivec3 cells = levels_.front().cells;
    std::vector<float> placed(places(cells)), values;
    pressure().read(std::span<float>(placed));
    values.reserve(static_cast<std::size_t>(count(cells)));
    const int row = (cells.x + 3) / 2, slab = row * (cells.y + 2);
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i)
                values.push_back(placed[static_cast<std::size_t>((i + 1) / 2 + row * (j + 1) + slab * (k + 1) +
                                                                 (i + j + k) % 2 * slab * (cells.z + 2))]);
    return values;
}

std::size_t PressureOnGpu::bytes() const {
    std::size_t sum = other_.bytes() + inverse_.bytes() + runs_.bytes() + regions_.bytes();
    for (const Level& level : levels_)
        sum += level.pressure.bytes() + level.rightSide.bytes() + level.operation.bytes() + level.wide.bytes();
    return sum;
}

}  // namespace dustbench::grid_fluid::flow_gl
