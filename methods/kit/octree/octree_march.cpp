#include "methods/kit/octree/octree_march.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/gpu/draw_call.h"
#include "octree_shaders.h"

namespace dustbench::octree {
namespace {

glm::vec4 meanColour(const glm::vec3& weighted, float extinction) {
    return extinction > 0 ? glm::vec4(weighted / extinction, 1) : glm::vec4(0);
}

constexpr std::size_t texelsPerRow = marchTexelsPerRow, maximumRows = maximumMarchRows;

/// True if a box, given by its corners relative to the eye, is entirely beyond the near plane.
bool isBeforeNearPlane(const glm::dvec3& minimum, const glm::dvec3& maximum, const glm::dvec3& forward,
                       double nearMetres) {
    double nearest = 0;  // distance of the nearest corner along the camera's axis
    for (int axis = 0; axis < 3; ++axis)
        nearest += std::min(forward[axis] * minimum[axis], forward[axis] * maximum[axis]);
    return nearest > 1.001 * nearMetres;
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

MarchRays marchRays(const scene::View& view) {
    const glm::dmat3 axes = glm::transpose(glm::dmat3(glm::mat3(view.worldToEye())));
    const double pixel = 2 * std::tan(view.camera.verticalFieldOfView / 2) / view.height;
    const glm::dvec3 right = pixel * axes[0], up = pixel * axes[1];
    return {-axes[2] - 0.5 * view.width * right - 0.5 * view.height * up, right, up};
}

OctreeMarch::OctreeMarch(gpu::Device& device) : device_(device), vertices_(device) {}

void OctreeMarch::upload(const MarchedTree& tree) {
    drawable_ = false;
    lattice_ = tree.lattice;
    tree_.set(tree);
    if (tree_.empty()) return;
    const std::size_t needed = (tree_.slots().size() + texelsPerRow - 1) / texelsPerRow;
    if (needed > maximumRows)
        throw InputError("render raycast: got an octree of " + std::to_string(tree_.slots().size() / 8) +
                         " blocks, allowed: up to " + std::to_string(maximumRows * texelsPerRow / 8));
    if (needed > rows_) {
        rows_ = std::min(needed + needed / 8, maximumRows);
        slots_ = gpu::Texture::make2D(device_, "octree march slots", gpu::Format::r32F, texelsPerRow,
                                      static_cast<int>(rows_));
    }
    tree_.pad(rows_ * texelsPerRow);
    slots_.write(tree_.slots());
    if (const auto colours = tree_.colours(); !colours.empty()) {
        if (colours_.bytes() == 0 || colours_.height() < static_cast<int>(rows_))
            colours_ = gpu::Texture::make2D(device_, "octree march colours", gpu::Format::rgba32F, texelsPerRow,
                                            static_cast<int>(rows_));
        colours_.write(std::span<const float>(&colours.data()->x, 4 * colours.size()));
    }
    drawable_ = true;
}

gpu::Program& OctreeMarch::program() {
    const bool coloured = !tree_.colours().empty();
    std::optional<gpu::Program>& made = coloured ? ownColours_ : oneColour_;
    if (!made) {
        std::map<std::string, std::string> definitions{{"ROW_BITS", std::to_string(marchRowBits)}};
        if (coloured) definitions["COLOURED"] = "";
        made.emplace(device_, "octree march",
                     std::initializer_list<gpu::ShaderFile>{octree_shaders::octree_march_vert,
                                                            octree_shaders::octree_march_frag},
                     definitions);
    }
    return *made;
}

void OctreeMarch::draw(const scene::View& view, const glm::vec3& colourOfAll, const gpu::Layer& layer) {
    if (!drawable_) return;
    gpu::Program& program = this->program();
    const glm::mat4 worldToEye = view.worldToEye(), eyeToClip = view.eyeToClip();
    const MarchRays rays = marchRays(view);

    // Subtract the eye in double precision, so that the world may lie anywhere.
    const double cellMetres = lattice_.cellEdgeMetres(lattice_.depth);
    const glm::dvec3 eyeMetres = view.camera.eye - lattice_.origin;
    program.set("levels", lattice_.depth);
    program.set("eye", glm::vec3(eyeMetres / cellMetres));
    program.set("minimum", glm::vec3(tree_.minimum()));
    program.set("maximum", glm::vec3(tree_.maximum()));
    program.set("rayCorner", glm::vec3(rays.corner));
    program.set("rayRight", glm::vec3(rays.right));
    program.set("rayUp", glm::vec3(rays.up));
    program.set("nearDistance", static_cast<float>(view.camera.nearMetres / cellMetres));
    if (tree_.colours().empty()) program.set("colourOfAll", colourOfAll);

    // Slightly larger than the voxels, because rasterisers round corners; rays that miss end immediately.
    const glm::dvec3 minimum = cellMetres * (glm::dvec3(tree_.minimum()) - 0.5) - eyeMetres;
    const glm::dvec3 maximum = cellMetres * (glm::dvec3(tree_.maximum()) + 0.5) - eyeMetres;
    const glm::dvec3 forward = -glm::dvec3(glm::transpose(glm::mat3(worldToEye))[2]);
    const bool wholePicture = !isBeforeNearPlane(minimum, maximum, forward, view.camera.nearMetres);
    program.set("wholePicture", wholePicture ? 1 : 0);
    program.set("boxMinimum", glm::vec3(minimum));
    program.set("boxMaximum", glm::vec3(maximum));
    program.set("worldToEye", worldToEye);
    program.set("projection", glm::vec3(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres));

    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    state.cullBackFaces = !wholePicture;
    layer.bindColourOnly();
    layer.sceneDepth().bind(0);
    slots_.bind(1);
    if (!tree_.colours().empty()) colours_.bind(2);
    gpu::draw(program, vertices_, state, gpu::Primitives::triangles, wholePicture ? 3 : 36);
}

}  // namespace dustbench::octree
