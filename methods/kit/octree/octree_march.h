// Draws an octree by marching along each pixel's ray through the tree, front to back.
//
// Exact, up to rounding, for constant extinction in each voxel: needs no step length and no voxel order. A ray ends at
// the scene, at the end of the voxels, or when its transmittance falls below 2^-14.
//
// Units: m, extinction per metre. Frame: world. Colours: linear RGB. Owns: the tree's slots, on the GPU and on the CPU.
// Threads: the OpenGL thread. Source: Carr2006, 5. Departs: implements the "altogether different" drawing that the
// paper leaves to future work.
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

/// Texels per row, and rows, of the textures with the slots: limits guaranteed by OpenGL 4.5.
inline constexpr int marchRowBits = 12, marchTexelsPerRow = 1 << marchRowBits, maximumMarchRows = 16384;

/// The rays through pixels (x, y), y from the bottom: corner + x·right + y·up, of length 1 along the camera's axis.
struct MarchRays {
    glm::dvec3 corner, right, up;
};
[[nodiscard]] MarchRays marchRays(const scene::View& view);

class OctreeMarch {
 public:
    explicit OctreeMarch(gpu::Device& device);

    /// Copies all data to draw; the tree need not outlive the call. Throws like OctreeMarchTree::set, and InputError if
    /// there are more than 2^23 blocks; nothing is drawn after an error.
    void upload(const MarchedTree& tree);

    /// Draws the tree uploaded last; may be called repeatedly. `colourOfAll` applies to trees without colours.
    void draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer);

    [[nodiscard]] std::size_t gpuBytes() const { return slots_.bytes() + colours_.bytes(); }
    [[nodiscard]] std::size_t cpuBytes() const { return tree_.bytes(); }

 private:
    [[nodiscard]] gpu::Program& program();

    gpu::Device& device_;
    Lattice lattice_;
    OctreeMarchTree tree_;
    gpu::Texture slots_;  ///< row by row; likewise the colours
    gpu::Texture colours_;
    std::size_t rows_ = 0;
    bool drawable_ = false;  ///< false if the tree is empty or an upload failed
    gpu::VertexArray vertices_;
    std::optional<gpu::Program> oneColour_, ownColours_;  ///< compiled on first use
};

}  // namespace dustbench::octree
