#include "methods/voxel_shape/particles/dust_flow.h"

#include <algorithm>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {
namespace {

/// Cells along the shape's longest side; a puff is about as wide as a cell.
constexpr int cellsASide = 12;

}  // namespace

template <typename Nodes, typename Visit>
void DustFlow::forNodesAround(Nodes& nodes, const glm::vec3& place, const Visit& visit) const {
    const glm::ivec3 cell(glm::floor(place));
    if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell + 1, counts_))) return;
    const glm::vec3 share = place - glm::vec3(cell);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 along = glm::mix(1.0f - share, share, glm::vec3(step));
        const glm::ivec3 at = cell + step;
        visit(nodes[static_cast<std::size_t>((at.z * counts_.y + at.y) * counts_.x + at.x)],
              along.x * along.y * along.z);
    }
}

void DustFlow::drawAlong(ShapeSystem& moved, const Puffs& dust, float share) {
    const Lattice& lattice = moved.grid().lattice();
    const Pose& pose = moved.pose();
    const float longest = lattice.edgeMetres *
                          static_cast<float>(glm::max(glm::max(lattice.counts.x, lattice.counts.y), lattice.counts.z));
    const float edge = longest / cellsASide;
    // One more cell on each side, to include particles that have just left.
    const glm::vec3 origin = lattice.origin - edge;
    counts_ = glm::ivec3(glm::ceil((lattice.maximumCorner() - lattice.origin) / edge)) + 3;
    nodes_.assign(
        static_cast<std::size_t>(counts_.x) * static_cast<std::size_t>(counts_.y) * static_cast<std::size_t>(counts_.z),
        {});
    const auto placeOf = [&](const glm::vec3& world) { return (pose.toLocal(world) - origin) / edge; };
    for (std::size_t i = 0; i < dust.size(); ++i) {
        const glm::vec3 velocity(dust.velocityX[i], dust.velocityY[i], dust.velocityZ[i]);
        forNodesAround(nodes_, placeOf(dust.position(i)), [&](Node& node, float weight) {
            node.velocity += weight * velocity;
            node.weight += weight;
        });
    }
    particles::ParticleStore& s = moved.particles().store;
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            glm::vec3 sum(0);
            float weight = 0;
            forNodesAround(nodes_, placeOf(s.position(i)), [&](const Node& node, float part) {
                sum += part * node.velocity;
                weight += part * node.weight;
            });
            if (!(weight > 1e-3f)) continue;
            const glm::vec3 own(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
            const glm::vec3 drawn = own + share * std::min(1.0f, weight) * (sum / weight - own);
            s.velocityX[i] = drawn.x;
            s.velocityY[i] = drawn.y;
            s.velocityZ[i] = drawn.z;
        }
    });
}

}  // namespace dustbench::voxel_shape
