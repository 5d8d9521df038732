// Octree dust by the search principle.
#include "methods/kit/octree/brick_builder.h"
#include "methods/kit/octree/gpu/gpu_octree_dust.h"
#include "methods/kit/octree/octree_dust.h"
#include "methods/octree_search/grid_reducer.h"
#include "methods/octree_search/insertion_builder.h"
#include "methods/octree_search/paper_builder.h"

namespace dustbench::octree_search {

MethodInfo describe() {
    MethodInfo info;
    info.title = "Octree dust, search";
    info.summary =
        "Inserts each particle into an octree by searching from the root, and lists the voxels in one traversal.";
    info.source = "Carr2006";
    info.takesLights = true;
    octree::declareDust(info);
    octree::declareLayout(info,
                          "the paper's construction, with cells computed in advance (Morton codes are the paths) or as "
                          "printed; or a current one: bricks of 16³ cells in parallel, with a small grid each; or, on "
                          "the GPU, runs of particles sorted by Morton code");
    info.takesGpuDust = octree::isBuiltOnGpu;
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        if (octree::isBuiltOnGpu(values)) return std::make_unique<octree::GpuOctreeDust>(octree::dustSettings(values));
        return std::make_unique<octree::OctreeDust>(
            octree::dustSettings(values),
            [layout = values.choice("layout")](MemoryLedger& ledger) -> std::unique_ptr<octree::OctreeBuilder> {
                if (layout == "paper") return std::make_unique<PaperBuilder>(ledger);
                if (layout == "faithful") return std::make_unique<InsertionBuilder>(ledger);
                return std::make_unique<octree::BrickBuilder<GridReducer>>(ledger);
            });
    };
    return info;
}

}  // namespace dustbench::octree_search
