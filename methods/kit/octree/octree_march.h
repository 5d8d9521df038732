// Draws an octree by marching through the tree itself along each pixel's ray, front to back.
//
// Exact for an extinction constant in each voxel, up to rounding: no step length, no order of voxels. A ray ends at the
// scene, at the end of the voxels, or where less than 2^-14 of the light behind it would come through.
//
// Units: m, extinction per metre. Frame: world. Colours: linear RGB. Owns: the tree's slots, on the GPU and beside it.
// Threads: the OpenGL thread's. Source: Carr2006, 5. Departs: the "altogether different" drawing that it leaves to the
// future.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "methods/contract/view.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/gpu/vertex_array.h"
#include "methods/kit/octree/octree_march_tree.h"

namespace dustbench::octree {

class OctreeMarch {
 public:
    explicit OctreeMarch(gpu::Device& device);

    /// Takes over all that is drawn; the tree may go afterwards. Throws as OctreeMarchTree::set does, and InputError
    /// where there are more than 2^23 blocks; then nothing is drawn.
    void upload(const MarchedTree& tree);

    /// Draws what was uploaded last, as often as wanted. `colourOfAll` is for trees without colours of their own.
    void draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer);

    [[nodiscard]] std::size_t gpuBytes() const { return slots_.bytes() + colours_.bytes(); }
    [[nodiscard]] std::size_t cpuBytes() const { return tree_.bytes(); }

 private:
    [[nodiscard]] gpu::Program& program();

    gpu::Device& device_;
    Lattice lattice_;
    OctreeMarchTree tree_;
    gpu::Texture slots_;  ///< in rows one after another; colours alike
    gpu::Texture colours_;
    std::size_t rows_ = 0;
    bool drawable_ = false;  ///< false where there is nothing, or an upload failed
    gpu::VertexArray vertices_;
    std::optional<gpu::Program> oneColour_, ownColours_;  ///< made when first wanted
};

}  // namespace dustbench::octree
