#include "methods/shared/fluid_gl/sources_on_gpu.h"

#include <cmath>
#include <vector>

#include "fluid_gl_shaders.h"
#include "methods/shared/fluid/source_reach.h"

namespace dustbench::fluid_gl {
namespace {

using namespace fluid_gl_shaders;

/// As sources.glsl has it.
struct Source {
    glm::ivec4 first, last, middle;
    glm::vec4 offset, velocity;
    float density, kelvin, reaction, amount;
};

Source sourceFor(const fluid::FluidSource& source, const fluid::SourceReach& reach, const fluid::FluidBox& box,
                 float seconds) {
    // From the nearest whole cell within reach: far from 0 a float would not tell cells apart.
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

void SourcesOnGpu::add(const CellsOnGpu& state, const gpu::Buffer& kinds, const fluid::FluidBox& box,
                       std::span<const fluid::FluidSource> sources, float stepSeconds) {
    std::vector<Source> made;
    glm::ivec3 least = box.cells, most(-1);
    for (const fluid::FluidSource& source : sources) {
        const fluid::SourceReach reach = fluid::reachOf(source, box);
        if (reach.empty()) continue;
        made.push_back(sourceFor(source, reach, box, stepSeconds));
        least = glm::min(least, reach.first);
        most = glm::max(most, reach.last);
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
    add_.set("least", least);
    add_.run(most - least + 1);
}

}  // namespace dustbench::fluid_gl
