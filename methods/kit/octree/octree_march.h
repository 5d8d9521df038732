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
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "methods/contract/view.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree.h"

namespace dustbench::octree {

/// Input of the ray march. A coarse voxel may overlap finer ones; their extinctions add up.
struct MarchedTree {
    Lattice lattice;
    std::span<const NodeBlock> blocks;          ///< empty: no voxels
    std::span<const float> extinctionPerMetre;  ///< of each voxel
    std::span<const glm::vec3> colours;         ///< of each voxel, linear RGB; empty: all share one colour
};

/// A tree of node blocks prepared for ray marching: extinctions summed from the root down, one float per node.
///
/// Each node becomes a slot. A positive slot is the index of the block of its children (an exact float up to 2^24).
/// Otherwise it is minus the optical depth of the node's cell and all voxels that overlap it, per edge of a finest cell
/// and in powers of 2. A block's slots are 8·block + octant; block 0 holds the root's children; blocks are in
/// breadth-first order. Owns the slots; their memory is kept.
class OctreeMarchTree {
 public:
    /// Throws std::invalid_argument if the blocks do not form a tree of at most `depth` levels, or refer to missing
    /// voxels.
    void set(const MarchedTree& tree);

    /// Appends empty slots up to `count`.
    void pad(std::size_t count) {
        slots_.resize(count);
        if (!colours_.empty()) colours_.resize(count);
    }

    [[nodiscard]] std::span<const float> slots() const { return slots_; }
    /// Mean colour weighted by extinction, one per slot; empty if all voxels share one colour.
    [[nodiscard]] std::span<const glm::vec4> colours() const { return colours_; }

    /// Range [minimum, maximum) of finest cells that contains all voxels; empty if there are none.
    [[nodiscard]] const glm::ivec3& minimum() const { return minimum_; }
    [[nodiscard]] const glm::ivec3& maximum() const { return maximum_; }
    [[nodiscard]] bool empty() const { return maximum_.x <= minimum_.x; }
    /// Bytes of memory held.
    [[nodiscard]] std::size_t bytes() const {
        return queue_.capacity() * sizeof(Pending) + slots_.capacity() * sizeof(float) +
               colours_.capacity() * sizeof(glm::vec4);
    }

 private:
    /// A node whose children are still to be written, with the sums over its ancestors.
    struct Pending {
        NodeSlot node;
        int level;           ///< of its children
        glm::ivec3 minimum;  ///< in finest cells
        float extinctionPerMetre;
        glm::vec3 weightedColour;
    };
    void write(const MarchedTree& tree, const Pending& pending, std::size_t slot);

    std::vector<Pending> queue_;
    std::size_t blocksLeft_ = 0;  ///< blocks of the tree still to visit, including the current one; each is visited
                                  ///< once
    std::vector<float> slots_;
    std::vector<glm::vec4> colours_;
    glm::ivec3 minimum_{0}, maximum_{0};
};

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
