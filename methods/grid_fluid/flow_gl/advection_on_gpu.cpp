#include "methods/grid_fluid/flow_gl/advection_on_gpu.h"

#include "grid_fluid_flow_gl_shaders.h"
#include "methods/grid_fluid/flow/evened_corrections.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

using Definitions = std::map<std::string, std::string>;

bool extrapolates(const flow::AdvectionRule& rule) {
    return rule.velocityAt == flow::VelocityAt::middle;
}

Definitions timeOf(const flow::AdvectionRule& rule) {
    return extrapolates(rule) ? Definitions{{"EXTRAPOLATED", ""}} : Definitions{};
}

Definitions correctionOf(const flow::AdvectionRule& rule) {
    Definitions definitions = timeOf(rule);
    definitions["LIMIT"] = std::to_string(static_cast<int>(rule.limit));
    definitions["PATH_TOLERANCE"] = std::to_string(flow::pathTolerance);
    return definitions;
}

}  // namespace

std::size_t AdvectionOnGpu::largestBytes(const flow::CellLayout& layout, flow::AdvectionRule rule) {
    return layout.padded() * CellsOnGpu::bytesMoving * (extrapolates(rule) ? 2 : 1);
}

std::size_t AdvectionOnGpu::allBytes(const flow::CellLayout& layout, flow::AdvectionRule rule) {
    return largestBytes(layout, rule) + (extrapolates(rule) ? layout.padded() * CellsOnGpu::bytesMoving : 0);
}

AdvectionOnGpu::AdvectionOnGpu(gpu::Device& device, const flow::CellLayout& layout, flow::AdvectionRule rule)
    : cells_(layout.nx, layout.ny, layout.nz),
      corrected_(rule.scheme == flow::AdvectionScheme::macCormack),
      halfway_(device, "fluid paths", largestBytes(layout, rule)),
      centres_(device, {grid_glsl, centres_comp}, timeOf(rule)),
      findHalfway_(device, {grid_glsl, sampling_glsl, halfway_comp}, timeOf(rule)),
      predict_(device, {grid_glsl, kinds_glsl, sampling_glsl, paths_glsl, predict_comp}),
      correct_(device, {grid_glsl, kinds_glsl, sampling_glsl, paths_glsl, correct_comp}, correctionOf(rule)),
      addCorrections_(device, {grid_glsl, add_corrections_comp},
                      {{"KEPT_OF_SPEEDS", std::to_string(flow::keptOfSpeeds)},
                       {"KEPT_OF_CENTRES", std::to_string(flow::keptOfCentres)}}) {
    for (Kernel* kernel : {&centres_, &findHalfway_, &predict_, &correct_, &addCorrections_})
        kernel->set("cells", cells_);
    if (!extrapolates(rule)) return;
    last_.emplace(
        Last{gpu::Buffer(device, "fluid velocities of the last step", layout.padded() * CellsOnGpu::bytesMoving),
             Kernel(device, {grid_glsl, last_velocities_comp}), Kernel(device, {grid_glsl, scroll_velocities_comp})});
    last_->velocities.clear();
    for (Kernel* kernel : {&last_->keep, &last_->scroll}) kernel->set("cells", cells_);
}

void AdvectionOnGpu::findPaths(const CellsOnGpu& cells, const CellsOnGpu& spare, const StepReportOnGpu& report,
                               float cellsPerSpeed, float ahead) {
    cells.moving.bindStorage(1);
    spare.moving.bindStorage(5);  // the centres' velocities, until something else is written
    report.bind();
    if (last_) {
        last_->velocities.bindStorage(2);
        centres_.set("ahead", ahead);
    }
    centres_.run(cells_ + 2);
    halfway_.bindStorage(6);
    findHalfway_.set("cellsPerSpeed", cellsPerSpeed);
    findHalfway_.run(cells_ + 2);
}

void AdvectionOnGpu::advect(CellsOnGpu& cells, CellsOnGpu& spare, const CellsOnGpu& guess, const gpu::Buffer& kinds,
                            const StepReportOnGpu& report, float cellsPerSpeed, float ahead) {
    findPaths(cells, spare, report, cellsPerSpeed, ahead);
    kinds.bindStorage(0);
    cells.bind(1);
    (corrected_ ? guess : spare).bind(3);
    halfway_.bindStorage(5);
    predict_.set("cellsPerSpeed", cellsPerSpeed);
    predict_.run(cells_ + 1);
    if (!corrected_) {
        keepVelocities(cells);
        std::swap(cells, spare);
        return;
    }
    spare.bind(6);
    correct_.set("cellsPerSpeed", cellsPerSpeed);
    correct_.run(cells_);
    keepVelocities(cells);
    cells.bind(1);
    addCorrections_.run(cells_);
}

void AdvectionOnGpu::keepVelocities(const CellsOnGpu& cells) const {
    if (!last_) return;
    cells.moving.bindStorage(1);
    last_->velocities.bindStorage(2);
    last_->keep.run(cells_);
}

void AdvectionOnGpu::scroll(const glm::ivec3& by, const glm::vec3& wind, CellsOnGpu& spare) {
    if (!last_) return;
    last_->velocities.bindStorage(1);
    spare.moving.bindStorage(2);
    last_->scroll.set("by", by);
    last_->scroll.set("wind", wind);
    last_->scroll.run(cells_);
    std::swap(last_->velocities, spare.moving);
}

}  // namespace dustbench::grid_fluid::flow_gl
