#include "methods/grid_fluid/flow_gl/solids_on_gpu.h"

#include <fmt/format.h>

#include <algorithm>

#include "grid_fluid_flow_gl_shaders.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

std::map<std::string, std::string> ghostDefinitions(const flow::GhostRule& rule) {
    const glm::vec3& wind = rule.windMetresPerSecond;
    return {{"SIDES", sidesText(rule.sides)},
            {"WIND", fmt::format("vec3({:.9e}, {:.9e}, {:.9e})", wind.x, wind.y, wind.z)}};
}

constexpr std::size_t maximumMotions = 255;

std::size_t inWords(std::size_t bytes) {
    return (bytes + 3) / 4 * 4;
}

}  // namespace

GhostsOnGpu::GhostsOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::GhostRule& rule)
    : cells_(cells),
      ghosts_(device, {grid_glsl, ghosts_comp}, ghostDefinitions(rule)),
      sideFaces_(device, {grid_glsl, side_faces_comp}, ghostDefinitions(rule)) {
    for (Kernel* kernel : {&ghosts_, &sideFaces_}) kernel->set("cells", cells);
    ghosts_.set("noSlip", rule.noSlip ? 1 : 0);
}

void GhostsOnGpu::fill(const CellsOnGpu& state) {
    state.bind(1);
    ghosts_.run({std::max(cells_.x, cells_.y) + 2, std::max(cells_.y, cells_.z) + 2, 6});
}

void GhostsOnGpu::setSideFaces(const CellsOnGpu& state) {
    state.moving.bindStorage(1);
    sideFaces_.run({std::max(cells_.x, cells_.y), std::max(cells_.y, cells_.z), 6});
}

SolidsOnGpu::SolidsOnGpu(gpu::Device& device, const flow::CellLayout& layout, const flow::Sides& sides,
                         MemoryAccount& account)
    : device_(device),
      layout_(layout),
      conductance_(account),
      kinds_(device, "fluid solids", layout.padded() * sizeof(std::uint32_t)),
      bodies_(device, "fluid solids", inWords(layout.rows() * static_cast<std::size_t>(layout.nx))),
      motions_(device, "fluid solids", maximumMotions * sizeof(Motion)),
      velocities_(device, "fluid solids", sizeof(glm::vec3)),
      mask_(device, {grid_glsl, mask_comp}),
      fill_(device, {grid_glsl, kinds_glsl, solids_comp}),
      extend_(device, {grid_glsl, kinds_glsl, extend_comp}) {
    conductance_.resize(layout.padded());
    flow::conductEverywhere(layout, sides, conductance_);
    const std::vector<std::uint32_t> kinds(conductance_.begin(), conductance_.end());
    kinds_.write(std::span<const std::uint32_t>(kinds));
    const glm::ivec3 cells(layout.nx, layout.ny, layout.nz);
    for (Kernel* kernel : {&mask_, &fill_, &extend_}) kernel->set("cells", cells);
    fill_.set("motionCount", 0);
}

bool SolidsOnGpu::set(const flow::SolidMask& mask) {
    flow::check(mask, layout_);
    if (mask.body.empty() && !any_) return false;
    any_ = !mask.body.empty();
    const auto width = static_cast<std::size_t>(layout_.nx);
    parallel::forEachBlock(layout_.rows(), 64, [&](std::size_t first, std::size_t rows) {
        for (std::size_t r = first; r < first + rows; ++r) {
            std::uint8_t* conductance = conductance_.data() + layout_.at(0, layout_.rowJ(r), layout_.rowK(r));
            for (std::size_t i = 0; i < width; ++i)
                conductance[i] = any_ && mask.body[r * width + i] != 0 ? std::uint8_t{0} : std::uint8_t{1};
        }
    });
    std::vector<Motion> motions;
    for (std::size_t n = 0; n < std::min(mask.motions.size(), maximumMotions); ++n) {
        const flow::BodyMotion& motion = mask.motions[n];
        motions.push_back({glm::vec4(motion.velocity, motion.byCell ? 1 : 0), glm::vec4(motion.turnPerCell, 0),
                           glm::vec4(motion.centreCells, 0)});
    }
    if (any_ && !mask.velocities.empty()) {
        if (velocities_.bytes() < mask.velocities.size_bytes())
            velocities_ = gpu::Buffer(device_, "fluid solids", mask.velocities.size_bytes());
        velocities_.write(mask.velocities);
    }
    motions_.write(std::span<const Motion>(motions));
    fill_.set("motionCount", static_cast<int>(motions.size()));
    if (any_) bodies_.write(mask.body);
    mask_.set("anySolid", any_ ? 1 : 0);
    kinds_.bindStorage(0);
    bodies_.bindStorage(1);
    mask_.run({layout_.nx, layout_.ny, layout_.nz});
    return true;
}

void SolidsOnGpu::fill(const CellsOnGpu& cells) const {
    if (!any_) return;
    kinds_.bindStorage(0);
    cells.bind(1);
    motions_.bindStorage(3);
    velocities_.bindStorage(4);
    fill_.run(glm::ivec3(layout_.nx, layout_.ny, layout_.nz) + 1);
}

void SolidsOnGpu::extendInto(const CellsOnGpu& cells, bool slip) {
    if (!any_) return;
    kinds_.bindStorage(0);
    cells.bind(1);
    extend_.set("slip", slip ? 1 : 0);
    extend_.run({layout_.nx, layout_.ny, layout_.nz});
}

std::vector<std::vector<flow::Run>> SolidsOnGpu::closedRegions() const {
    return flow::closedRegions(layout_, conductance_.data());
}

}  // namespace dustbench::grid_fluid::flow_gl
