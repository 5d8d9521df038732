#include "methods/grid_fluid/flow_gl/forces_on_gpu.h"

#include <cmath>
#include <vector>

#include "grid_fluid_flow_gl_shaders.h"
#include "methods/grid_fluid/flow/fluid_source.h"

namespace dustbench::grid_fluid::flow_gl {
namespace {

using namespace grid_fluid_flow_gl_shaders;

/// Layout as in sources.glsl.
struct Source {
    glm::ivec4 first, last, middle;
    glm::vec4 offset, velocity;
    float density, kelvin, reaction, amount;
};

Source sourceFor(const flow::FluidSource& source, const flow::SourceReach& reach, const flow::FluidBox& box,
                 float seconds) {
    // Relative to the nearest reachable cell: far from 0 a float could not distinguish cells.
    const glm::dvec3 middle =
        glm::clamp(glm::round(reach.centreCells), glm::dvec3(reach.first), glm::dvec3(reach.last));
    const double cellM3 = box.spacingMetres * box.spacingMetres * box.spacingMetres;
    const bool hasAmount = source.amountM3PerSecond > 0;
    Source made;
    made.first = glm::ivec4(reach.first, 0);
    made.last = glm::ivec4(reach.last, 0);
    made.middle = glm::ivec4(glm::ivec3(middle), hasAmount ? 1 : 0);
    made.offset = glm::vec4(glm::vec3(reach.centreCells - middle), reach.perRadius);
    made.velocity = glm::vec4(source.velocityMetresPerSecond, 1 - std::exp(-source.velocityPerSecond * seconds));
    made.density = source.densityPerSecond * seconds;
    made.kelvin = source.kelvinPerSecond * seconds;
    made.reaction = source.reaction;
    made.amount =
        hasAmount ? static_cast<float>(static_cast<double>(source.amountM3PerSecond * seconds) / cellM3) : 0.0f;
    return made;
}

std::map<std::string, std::string> definitionsFor(const flow::ForceSettings& settings) {
    if (!(settings.confinementPerSecond > 0)) return {};
    return {{"CONFINED", ""}};
}

}  // namespace

SourcesOnGpu::SourcesOnGpu(gpu::Device& device, const glm::ivec3& cells)
    : device_(device),
      amounts_(device, {grid_glsl, kinds_glsl, sources_glsl, source_amounts_comp}),
      add_(device, {grid_glsl, kinds_glsl, sources_glsl, sources_comp}) {
    amounts_.set("cells", cells);
    add_.set("cells", cells);
}

void SourcesOnGpu::add(const CellsOnGpu& state, const gpu::Buffer& kinds, const flow::FluidBox& box,
                       std::span<const flow::FluidSource> sources, float stepSeconds) {
    std::vector<Source> made;
    glm::ivec3 minimum = box.cells, maximum(-1);
    for (const flow::FluidSource& source : sources) {
        const flow::SourceReach reach = flow::reachOf(source, box);
        if (reach.empty()) continue;
        made.push_back(sourceFor(source, reach, box, stepSeconds));
        minimum = glm::min(minimum, reach.first);
        maximum = glm::max(maximum, reach.last);
    }
    if (made.empty()) return;
    if (sources_.bytes() < made.size() * sizeof(Source)) {
        sources_ = gpu::Buffer(device_, "fluid sources", made.size() * sizeof(Source));
        added_ = gpu::Buffer(device_, "fluid sources", made.size() * sizeof(float));
    }
    sources_.write(std::span<const Source>(made));
    const auto count = static_cast<int>(made.size());
    kinds.bindStorage(0);
    state.bind(1);
    sources_.bindStorage(3);
    added_.bindStorage(4);
    amounts_.set("count", count);
    amounts_.runGroups(count);
    add_.set("count", count);
    add_.set("minimum", minimum);
    add_.run(maximum - minimum + 1);
}

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
