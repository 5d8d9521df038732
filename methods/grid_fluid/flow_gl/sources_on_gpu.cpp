#include "methods/grid_fluid/flow_gl/sources_on_gpu.h"

#include <cmath>
#include <vector>

#include "grid_fluid_flow_gl_shaders.h"
#include "methods/grid_fluid/flow/source_reach.h"

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

}  // namespace dustbench::grid_fluid::flow_gl
