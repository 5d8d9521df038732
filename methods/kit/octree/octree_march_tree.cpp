#include "methods/kit/octree/octree_march_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace dustbench::octree {
namespace {

glm::vec4 meanColour(const glm::vec3& weighted, float extinction) {
    return extinction > 0 ? glm::vec4(weighted / extinction, 1) : glm::vec4(0);
}

}  // namespace

void OctreeMarchTree::set(const MarchedTree& tree) {
    const int depth = tree.lattice.depth;
    if (depth < 1 || depth > maximumDepth)
        throw std::invalid_argument("octree of depth " + std::to_string(depth) + ": expected 1 to " +
                                    std::to_string(maximumDepth));
    if (!tree.colours.empty() && tree.colours.size() != tree.extinctionPerMetre.size())
        throw std::invalid_argument(std::to_string(tree.colours.size()) + " colours for " +
                                    std::to_string(tree.extinctionPerMetre.size()) + " voxels");
    queue_.clear();
    const auto resize = [&](std::size_t blocks) {
        slots_.resize(8 * blocks);
        colours_.resize(tree.colours.empty() ? 0 : slots_.size());
    };
    resize(tree.blocks.size());
    blocksLeft_ = tree.blocks.size();
    minimum_ = glm::ivec3(std::numeric_limits<int>::max());
    maximum_ = glm::ivec3(0);

    if (!tree.blocks.empty()) queue_.push_back({NodeSlot{}, 1, glm::ivec3(0), 0, glm::vec3(0)});
    for (std::size_t next = 0; next < queue_.size(); ++next) {
        const Pending pending = queue_[next];             // a copy: the queue grows in the loop
        if (8 * next >= slots_.size()) resize(2 * next);  // families become blocks
        write(tree, pending, 8 * next);
    }
    resize(queue_.size());
}

void OctreeMarchTree::write(const MarchedTree& tree, const Pending& pending, std::size_t slot) {
    const int depth = tree.lattice.depth, cells = 1 << (depth - pending.level);
    const float scale = -static_cast<float>(tree.lattice.cellEdgeMetres(depth) * std::numbers::log2e);
    for (int octant = 0; octant < 8; ++octant, ++slot) {
        const NodeSlot node = NodeBlock::childOf(pending.node, static_cast<std::size_t>(octant), tree.blocks.data());
        if (!node.exists()) {  // the most common case
            slots_[slot] = scale * pending.extinctionPerMetre;
            if (!tree.colours.empty()) colours_[slot] = meanColour(pending.weightedColour, pending.extinctionPerMetre);
            continue;
        }
        const glm::ivec3 minimum = pending.minimum + cells * glm::ivec3(octant >> 2, octant >> 1 & 1, octant & 1);
        float extinction = pending.extinctionPerMetre;
        glm::vec3 colour = pending.weightedColour;
        if (node.hasVoxel()) {
            const std::size_t voxel = node.voxel - 1;
            if (voxel >= tree.extinctionPerMetre.size())
                throw std::invalid_argument("octree node with voxel " + std::to_string(voxel) + " of " +
                                            std::to_string(tree.extinctionPerMetre.size()));
            if (!(tree.extinctionPerMetre[voxel] >= 0 && std::isfinite(tree.extinctionPerMetre[voxel])))
                throw std::invalid_argument("octree voxel " + std::to_string(voxel) + " with extinction " +
                                            std::to_string(tree.extinctionPerMetre[voxel]) + " per metre");
            extinction += tree.extinctionPerMetre[voxel];
            if (!tree.colours.empty()) colour += tree.extinctionPerMetre[voxel] * tree.colours[voxel];
            minimum_ = glm::min(minimum_, minimum);
            maximum_ = glm::max(maximum_, minimum + cells);
        }
        if (node.children > 0) {
            const bool noBlock = !node.hasFamily() && (node.children >= tree.blocks.size() || --blocksLeft_ == 0);
            if (noBlock || pending.level == depth)
                throw std::invalid_argument("octree node of level " + std::to_string(pending.level) + " with block " +
                                            std::to_string(node.children) + " of " +
                                            std::to_string(tree.blocks.size()) + " as children: not a tree of depth " +
                                            std::to_string(depth));
            slots_[slot] = static_cast<float>(queue_.size());
            queue_.push_back({node, pending.level + 1, minimum, extinction, colour});
        } else {
            slots_[slot] = scale * extinction;
            if (!tree.colours.empty()) colours_[slot] = meanColour(colour, extinction);
        }
    }
}

}  // namespace dustbench::octree
