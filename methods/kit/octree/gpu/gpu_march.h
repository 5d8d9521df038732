// Draws an octree that the GPU has built by marching along each pixel's ray, as OctreeMarch does for trees of the CPU.
//
// Nodes are found from the list of voxels in pre-order: each voxel adds the blocks on its path that no earlier voxel
// has. A scan numbers them, and two passes fill them.
//
// Units: m, extinction per metre. Frame: world. Colours: linear RGB. Owns: the slots, with room for the largest
// possible tree of so many particles, up to 2^23 blocks. Threads: the OpenGL thread's. Source: Carr2006, 5.
#pragma once

#include <cstdint>
#include <memory>

#include "methods/contract/view.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/octree/gpu/gpu_octree.h"

namespace dustbench::octree {

class DUSTBENCH_API GpuMarch {
 public:
    explicit GpuMarch(gpu::Device& device);
    ~GpuMarch();
    GpuMarch(const GpuMarch&) = delete;
    GpuMarch& operator=(const GpuMarch&) = delete;

    /// Builds the nodes of the tree built last. `tree` must outlive the draws.
    void take(const GpuOctree& tree);
    void draw(const GpuOctree& tree, const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer);

    /// Blocks of the last tree. Waits for the GPU.
    [[nodiscard]] std::uint32_t readBlocks(std::uint32_t voxels) const;
    /// Maximum number of blocks: beyond it, nodes are missing.
    [[nodiscard]] std::uint32_t blockLimit() const;
    [[nodiscard]] std::size_t bytes() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace dustbench::octree
