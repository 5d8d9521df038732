#include "methods/shared/octree/octree_march_tree.h"

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
    slots_.resize(8 * tree.blocks.size());
    colours_.resize(tree.colours.empty() ? 0 : slots_.size());
    least_ = glm::ivec3(std::numeric_limits<int>::max());
    most_ = glm::ivec3(0);

    if (!tree.blocks.empty()) queue_.push_back({0, 1, glm::ivec3(0), 0, glm::vec3(0)});
    for (std::size_t next = 0; next < queue_.size(); ++next) {
        const Pending pending = queue_[next];  // the queue grows meanwhile
        write(tree, pending, 8 * next);
    }
    slots_.resize(8 * queue_.size());
    colours_.resize(tree.colours.empty() ? 0 : slots_.size());
}

void OctreeMarchTree::write(const MarchedTree& tree, const Pending& pending, std::size_t slot) {
    const int depth = tree.lattice.depth, cells = 1 << (depth - pending.level);
    const float scale = -static_cast<float>(tree.lattice.cellEdgeMetres(depth) * std::numbers::log2e);
    for (int octant = 0; octant < 8; ++octant, ++slot) {
        const NodeSlot& node = tree.blocks[pending.block].slots[static_cast<std::size_t>(octant)];
        if (node.voxel == 0 && node.children == 0) {  // as most are
            slots_[slot] = scale * pending.extinctionPerMetre;
            if (!tree.colours.empty()) colours_[slot] = meanColour(pending.weightedColour, pending.extinctionPerMetre);
            continue;
        }
        const glm::ivec3 least = pending.least + cells * glm::ivec3(octant >> 2, octant >> 1 & 1, octant & 1);
        float extinction = pending.extinctionPerMetre;
        glm::vec3 colour = pending.weightedColour;
        if (node.voxel > 0) {
            const std::size_t voxel = node.voxel - 1;
            if (voxel >= tree.extinctionPerMetre.size())
                throw std::invalid_argument("octree node with voxel " + std::to_string(voxel) + " of " +
                                            std::to_string(tree.extinctionPerMetre.size()));
            if (!(tree.extinctionPerMetre[voxel] >= 0 && std::isfinite(tree.extinctionPerMetre[voxel])))
                throw std::invalid_argument("octree voxel " + std::to_string(voxel) + " with extinction " +
                                            std::to_string(tree.extinctionPerMetre[voxel]) + " per metre");
            extinction += tree.extinctionPerMetre[voxel];
            if (!tree.colours.empty()) colour += tree.extinctionPerMetre[voxel] * tree.colours[voxel];
            least_ = glm::min(least_, least);
            most_ = glm::max(most_, least + cells);
        }
        if (node.children > 0) {
            if (node.children >= tree.blocks.size() || queue_.size() >= tree.blocks.size() || pending.level == depth)
                throw std::invalid_argument("octree node of level " + std::to_string(pending.level) + " with block " +
                                            std::to_string(node.children) + " of " +
                                            std::to_string(tree.blocks.size()) + " as children: no tree of depth " +
                                            std::to_string(depth));
            slots_[slot] = static_cast<float>(queue_.size());
            queue_.push_back({node.children, pending.level + 1, least, extinction, colour});
        } else {
            slots_[slot] = scale * extinction;
            if (!tree.colours.empty()) colours_[slot] = meanColour(colour, extinction);
        }
    }
}

}  // namespace dustbench::octree
