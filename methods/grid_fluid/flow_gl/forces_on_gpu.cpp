#include "methods/grid_fluid/flow_gl/forces_on_gpu.h"

#include <cmath>

#include "grid_fluid_flow_gl_shaders.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

std::map<std::string, std::string> definitionsFor(const flow::ForceSettings& settings) {
    if (!(settings.confinementPerSecond > 0)) return {};
    return {{"CONFINED", ""}};
}

}  // namespace

ForcesOnGpu::ForcesOnGpu(gpu::Device& device, const glm::ivec3& cells, const flow::ForceSettings& settings,
                         float spacingMetres)
    : cells_(cells),
      settings_(settings),
      spacingMetres_(spacingMetres),
      curl_(device, {grid_glsl, kinds_glsl, curl_comp}),
      centreForces_(device, {grid_glsl, centre_forces_comp}, definitionsFor(settings)),
      spread_(device, {grid_glsl, spread_comp}),
      forces_(device, {grid_glsl, kinds_glsl, forces_comp}),
      diffuse_(device, {grid_glsl, kinds_glsl, diffuse_comp}) {
    for (Kernel* kernel : {&curl_, &centreForces_, &spread_, &forces_, &diffuse_}) kernel->set("cells", cells);
    curl_.set("spacing", spacingMetres);
}

void ForcesOnGpu::apply(const CellsOnGpu& state, const CellsOnGpu& spare, const CellsOnGpu& otherSpare,
                        const gpu::Buffer& kinds, float seconds) {
    kinds.bindStorage(0);
    state.bind(1);
    if (settings_.confinementPerSecond > 0) {
        spare.moving.bindStorage(5);
        curl_.run(cells_);
        centreForces_.set("strength", settings_.confinementPerSecond * spacingMetres_ * seconds);
    }
    otherSpare.moving.bindStorage(6);
    centreForces_.set("lift", settings_.buoyancyPerKelvin * seconds);
    centreForces_.set("weight", settings_.weightPerDensity * seconds);
    centreForces_.run(cells_);
    if (settings_.confinementPerSecond > 0) {
        spread_.run(cells_);  // over the curl
        spare.moving.bindStorage(6);
    }
    forces_.set("keptDensity", std::exp(-settings_.densityDecayPerSecond * seconds));
    forces_.set("keptHeat", std::exp(-settings_.coolingPerSecond * seconds));
    forces_.set("lost", settings_.reactionLossPerSecond * seconds);
    forces_.run(cells_);
}

void ForcesOnGpu::diffuse(const CellsOnGpu& from, const CellsOnGpu& to, const gpu::Buffer& kinds, float diffusion) {
    kinds.bindStorage(0);
    from.moving.bindStorage(1);
    to.moving.bindStorage(3);
    diffuse_.set("diffusion", diffusion);
    diffuse_.run(cells_ + 1);
}

}  // namespace dustbench::grid_fluid::flow_gl
