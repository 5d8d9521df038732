// Octree dust by recursive construction.
#include "methods/kit/octree/brick_builder.h"
#include "methods/kit/octree/gpu/gpu_octree_dust.h"
#include "methods/kit/octree/octree_dust.h"
#include "methods/octree_recursive/list_builder.h"
#include "methods/octree_recursive/paper_builder.h"
#include "methods/octree_recursive/sorting_reducer.h"

namespace dustbench::octree_recursive {

MethodInfo describe() {
    MethodInfo info;
    info.title = "Octree dust, recursive";
    info.summary =
        "Splits the list of particles recursively into an octree's cells, and lists the voxels in the same recursion.";
    info.source = "Carr2006";
    info.takesLights = true;
    octree::declareDust(info);
    octree::declareLayout(info,
                          "the paper's construction, with cells computed in advance (lists are split by Morton codes) "
                          "or as printed; or a current one: bricks of 16³ cells in parallel, with sorted Morton codes; "
                          "or, on the GPU, runs of particles sorted by Morton code");
    info.takesGpuDust = octree::isBuiltOnGpu;
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        if (octree::isBuiltOnGpu(values)) return std::make_unique<octree::GpuOctreeDust>(octree::dustSettings(values));
        return std::make_unique<octree::OctreeDust>(
            octree::dustSettings(values),
            [layout = values.choice("layout")](MemoryLedger& ledger) -> std::unique_ptr<octree::OctreeBuilder> {
                if (layout == "paper") return std::make_unique<PaperBuilder>(ledger);
                if (layout == "faithful") return std::make_unique<ListBuilder>(ledger);
                return std::make_unique<octree::BrickBuilder<SortingReducer>>(ledger);
            });
    };
    return info;
}

}  // namespace dustbench::octree_recursive
