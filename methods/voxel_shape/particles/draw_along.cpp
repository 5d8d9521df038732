#include "methods/voxel_shape/particles/draw_along.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <utility>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {
namespace {

/// Cells along the shape's longest side; a puff is about as wide as a cell.
constexpr int cellsASide = 12;

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

NodesAround::NodesAround(const Lattice& voxels) {
    const glm::ivec3& n = voxels.counts;
    edgeMetres = voxels.edgeMetres * static_cast<float>(glm::max(glm::max(n.x, n.y), n.z)) / cellsASide;
    origin = voxels.origin - edgeMetres;
    counts = glm::ivec3(glm::ceil((voxels.maximumCorner() - voxels.origin) / edgeMetres)) + 3;
}

template <typename Nodes, typename Visit>
void NodesAround::around(Nodes& nodes, const glm::vec3& place, const Visit& visit) const {
    const glm::ivec3 cell(glm::floor(place));
    if (glm::any(glm::lessThan(cell, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(cell + 1, counts))) return;
    const glm::vec3 share = place - glm::vec3(cell);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::vec3 along = glm::mix(1.0f - share, share, glm::vec3(step));
        const glm::ivec3 at = cell + step;
        visit(nodes[static_cast<std::size_t>((at.z * counts.y + at.y) * counts.x + at.x)], along.x * along.y * along.z);
    }
}

void DustFlow::drawAlong(ShapeSystem& moved, const Puffs& dust, float share) {
    const NodesAround lattice(moved.grid().lattice());
    const Pose& pose = moved.pose();
    nodes_.assign(lattice.size(), {});
    const auto placeOf = [&](const glm::vec3& world) { return lattice.cellsOf(pose.toLocal(world)); };
    for (std::size_t i = 0; i < dust.size(); ++i) {
        const glm::vec3 velocity(dust.velocityX[i], dust.velocityY[i], dust.velocityZ[i]);
        lattice.around(nodes_, placeOf(dust.position(i)), [&](Node& node, float weight) {
            node.velocity += weight * velocity;
            node.weight += weight;
        });
    }
    particles::ParticleStore& s = moved.particles().store;
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            glm::vec3 sum(0);
            float weight = 0;
            lattice.around(nodes_, placeOf(s.position(i)), [&](const Node& node, float part) {
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

Flow flowOf(const volumes::VectorSeries& field, double timeSeconds) {
    return [moment = field.momentAt(timeSeconds)](const glm::vec3& world) { return moment.at(world); };
}

Flow flowOf(const volumes::VectorSeries& field, const Pose& pose, double timeSeconds) {
    return [moment = field.momentAt(timeSeconds), pose](const glm::vec3& world) {
        auto u = moment.at(pose.toLocal(world));
        if (u) *u = pose.velocityAt(world) + pose.scale * (pose.rotation * *u);
        return u;
    };
}

void drawAlong(particles::ParticleStore& moved, const Flow& flow, float share) {
    parallel::forEachBlock(moved.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const auto u = flow(moved.position(i));
            if (!u) continue;
            moved.velocityX[i] += share * (u->x - moved.velocityX[i]);
            moved.velocityY[i] += share * (u->y - moved.velocityY[i]);
            moved.velocityZ[i] += share * (u->z - moved.velocityZ[i]);
        }
    });
}

FlowWake::FlowWake(MemoryLedger& ledger, float massLoading, float fadeSeconds)
    : massLoading_(massLoading),
      fadeSeconds_(fadeSeconds),
      wake_(ledger.account("flow")),
      next_(ledger.account("flow")),
      loading_(ledger.account("flow")),
      gained_(ledger.account("flow")) {}

/// λ: `massLoading_` is the mass of a full voxel's particles by that of the voxel's air.
float FlowWake::particleByNode(const ShapeSystem& around, const NodesAround& lattice) const {
    const VoxelGrid& grid = around.grid();
    std::uint64_t room = 0;
    for (const std::uint32_t i : grid.active()) room += grid.voxels()[i].maximumDensity;
    const float voxelByNode = grid.lattice().edgeMetres / lattice.edgeMetres;
    return massLoading_ * voxelByNode * voxelByNode * voxelByNode * static_cast<float>(grid.active().size()) /
           static_cast<float>(std::max<std::uint64_t>(room, 1));
}

void FlowWake::exchange(ShapeSystem& moved, const Flow& flow, float drawsPerSecond, float seconds) {
    const NodesAround lattice(moved.grid().lattice());
    const Pose& pose = moved.pose();
    particles::ParticleStore& s = moved.particles().store;
    const float share = particleByNode(moved, lattice);
    const auto placeOf = [&](std::size_t i) { return lattice.cellsOf(pose.toLocal(s.position(i))); };
    wake_.resize(lattice.size(), glm::vec3(0));
    loading_.assign(lattice.size(), 0);
    gained_.resize(s.size());
    // Sums over particles by one thread, in the order of the particles.
    for (std::size_t i = 0; i < s.size(); ++i)
        lattice.around(loading_, placeOf(i), [&](float& node, float weight) { node += share * weight; });
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            gained_[i] = glm::vec3(0);
            const auto u = flow(s.position(i));
            if (!u) continue;
            const glm::vec3 place = placeOf(i);
            float loading = 0;
            glm::vec3 air = *u;
            lattice.around(loading_, place, [&](float node, float weight) { loading += weight * node; });
            lattice.around(wake_, place, [&](const glm::vec3& node, float weight) { air += weight * node; });
            const float nearer = -std::expm1(-drawsPerSecond * (1 + loading) * seconds) / (1 + loading);
            gained_[i] = nearer * (air - glm::vec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]));
            s.velocityX[i] += gained_[i].x;
            s.velocityY[i] += gained_[i].y;
            s.velocityZ[i] += gained_[i].z;
        }
    });
    for (std::size_t i = 0; i < s.size(); ++i)
        lattice.around(wake_, placeOf(i), [&](glm::vec3& node, float weight) { node -= share * weight * gained_[i]; });
}

void FlowWake::carry(const ShapeSystem& around, const Flow& flow, float seconds) {
    const NodesAround lattice(around.grid().lattice());
    const Pose& pose = around.pose();
    const float keeps = std::exp(-seconds / fadeSeconds_);
    wake_.resize(lattice.size(), glm::vec3(0));
    next_.assign(lattice.size(), glm::vec3(0));
    const auto layer = static_cast<std::size_t>(lattice.counts.x) * static_cast<std::size_t>(lattice.counts.y);
    parallel::forEachBlock(lattice.size(), layer, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::vec3 cell(i % layer % static_cast<std::size_t>(lattice.counts.x),
                                 i % layer / static_cast<std::size_t>(lattice.counts.x), i / layer);
            const glm::vec3 node = pose.toWorld(lattice.origin + lattice.edgeMetres * cell);
            // The nodes move with the shape.
            const glm::vec3 air = flow(node).value_or(pose.velocityAt(node)) + wake_[i] - pose.velocityAt(node);
            lattice.around(wake_, lattice.cellsOf(pose.toLocal(node - seconds * air)),
                           [&](const glm::vec3& from, float weight) { next_[i] += keeps * weight * from; });
        }
    });
    std::swap(wake_, next_);
}

glm::dvec3 FlowWake::momentumInParticles(const ShapeSystem& around) const {
    const float share = particleByNode(around, NodesAround(around.grid().lattice()));
    glm::dvec3 sum(0);
    for (const glm::vec3& node : wake_) sum += glm::dvec3(node);
    return sum / static_cast<double>(share);
}

glm::vec3 FlowWake::at(const ShapeSystem& around, const glm::vec3& world) const {
    const NodesAround lattice(around.grid().lattice());
    glm::vec3 sum(0);
    if (!wake_.empty())
        lattice.around(wake_, lattice.cellsOf(around.pose().toLocal(world)),
                       [&](const glm::vec3& node, float weight) { sum += weight * node; });
    return sum;
}

}  // namespace dustbench::voxel_shape
