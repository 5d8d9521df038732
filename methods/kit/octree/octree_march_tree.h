// A tree of node blocks prepared for ray marching: extinctions summed from the root down, one float per node.
//
// Each node becomes a slot. A positive slot is the index of the block of its children (an exact float up to 2^24).
// Otherwise it is minus the optical depth of the node's cell and all voxels that overlap it, per edge of a finest cell
// and in powers of 2. A block's slots are 8·block + octant; block 0 holds the root's children; blocks are in
// breadth-first order.
//
// Units: metres, extinction per metre. Frame: world. Owns: the slots; their memory is kept. Threads: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/node_block.h"

namespace dustbench::octree {

/// Input of the ray march. A coarse voxel may overlap finer ones; their extinctions add up.
struct MarchedTree {
    Lattice lattice;
    std::span<const NodeBlock> blocks;          ///< empty: no voxels
    std::span<const float> extinctionPerMetre;  ///< of each voxel
    std::span<const glm::vec3> colours;         ///< of each voxel, linear RGB; empty: all share one colour
};

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

}  // namespace dustbench::octree
