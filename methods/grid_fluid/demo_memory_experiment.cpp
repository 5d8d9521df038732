#include "methods/grid_fluid/demo_memory_experiment.h"

#include "methods/grid_fluid/flow_solver.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::grid_fluid::demo_memory {
namespace {

constexpr glm::ivec3 coarse{128, 64, 64}, fine{256, 128, 128};
constexpr glm::ivec2 picture{1920, 1080}, taller{1920, 1088};

Finding found(const char* name, double value) {
    return {name, value, value, value, 1};
}

std::vector<Finding> measureAll(gpu::Device& device) {
    constexpr double mega = 1e6;
    return {found("bytes_128x64x64", measureMemory(device, coarse, picture, true).total()),
            found("bytes_128x64x64_floats", measureMemory(device, coarse, picture, false).total()),
            found("megabytes_256x128x128", measureMemory(device, fine, picture, true).total() / mega),
            found("megabytes_256x128x128_1088", measureMemory(device, fine, taller, true).total() / mega)};
}

}  // namespace

DemoMemory measureMemory(gpu::Device& device, const glm::ivec3& cells, const glm::ivec2& pixels, bool asPublished) {
    flow::FluidSettings settings;
    settings.box.cells = cells;
    MemoryLedger onHost;
    DemoMemory memory;
    {
        const auto solver =
            makeFlowSolver(settings, asPublished ? FlowScheme::demo : FlowScheme::ours, false, true, device, onHost);
        for (const MemoryUse& use : solver->gpuMemory())
            if (use.structure != "demo report") memory.fields += use.gpuBytes;
    }
    const std::size_t before = device.ledger().totalBytes();
    const gpu::Texture depth = gpu::Texture::make2D(device, "depth", gpu::Format::depth32F, pixels.x, pixels.y);
    const gpu::Layer layer(device, depth);
    memory.picture = device.ledger().totalBytes() - before;
    return memory;
}

ExperimentInfo describe() {
    ExperimentInfo info;
    info.summary = "Measures the GPU memory of the published demo's fields and of its picture.";
    info.source = "Senger2009";
    info.run = [](ExperimentContext& context) { return measureAll(context.device()); };
    return info;
}

}  // namespace dustbench::grid_fluid::demo_memory
