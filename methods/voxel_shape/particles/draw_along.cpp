#include "methods/voxel_shape/particles/draw_along.h"

#include <algorithm>
#include <atomic>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {
namespace {

/// Cells along the shape's longest side; a puff is about as wide as a cell.
constexpr int cellsASide = 12;

/// `velocityAt`: u at a point of the world, or none beyond the grid.
template <typename VelocityAt>
void drawAlongField(particles::ParticleStore& s, float share, const VelocityAt& velocityAt) {
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const auto u = velocityAt(s.position(i));
            if (!u) continue;
            s.velocityX[i] += share * (u->x - s.velocityX[i]);
            s.velocityY[i] += share * (u->y - s.velocityY[i]);
            s.velocityZ[i] += share * (u->z - s.velocityZ[i]);
        }
    });
}

}  // namespace

std::size_t drawAlong(ShapeSystem& moved, const ShapeSystem& by, float share) {
    const Pose& pose = by.pose();
    const VoxelGrid& grid = by.grid();
    const Lattice& lattice = grid.lattice();
    particles::ParticleStore& s = moved.particles().store;
    std::atomic<std::size_t> met{0};
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        std::size_t found = 0;
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::vec3 place = s.position(i);
            const glm::vec3 at = lattice.toVoxels(pose.toLocal(place));
            if (glm::any(glm::lessThan(at, glm::vec3(0))) ||
                glm::any(glm::greaterThanEqual(at, glm::vec3(lattice.counts))) || !grid.at(glm::ivec3(at)).isOn())
                continue;
            const glm::vec3 own(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
            const glm::vec3 drawn = own + share * (pose.velocityAt(place) - own);
            s.velocityX[i] = drawn.x;
            s.velocityY[i] = drawn.y;
            s.velocityZ[i] = drawn.z;
            ++found;
        }
        met += found;
    });
    return met;
}

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

void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, double timeSeconds, float share) {
    const volumes::VectorSeries::Moment moment = flow.momentAt(timeSeconds);
    drawAlongField(moved, share, [&](const glm::vec3& world) { return moment.at(world); });
}

void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, const Pose& pose, double timeSeconds,
               float share) {
    const volumes::VectorSeries::Moment moment = flow.momentAt(timeSeconds);
    drawAlongField(moved, share, [&](const glm::vec3& world) {
        auto u = moment.at(pose.toLocal(world));
        if (u) *u = pose.velocityAt(world) + pose.scale * (pose.rotation * *u);
        return u;
    });
}

}  // namespace dustbench::voxel_shape
