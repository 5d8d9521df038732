#include "methods/kit/octree/plain_octree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace dustbench::octree {
namespace {

double finestEdgeMetres(const Lattice& lattice) {
    return lattice.edgeMetres / std::exp2(lattice.depth);
}

/// Levels above the finest.
int riseOf(const Puffs& store, std::size_t i, const Lattice& lattice, const OctreeSettings& settings) {
    const int highest = settings.levels - 1;
    if (settings.levelRule == LevelRule::age) {
        // ⌊L·age/lifetime⌋ in the precision of the attributes, so that products just below a whole number agree with
        // the fast kernels.
        const float levels = static_cast<float>(settings.levels);
        return std::min(highest, static_cast<int>(std::floor(levels * store.age[i] / store.lifetime[i])));
    }
    // The level whose edge is nearest to √(π/2)·r on a logarithmic scale.
    const double wanted = std::sqrt(std::numbers::pi / 2) * static_cast<double>(store.radius[i]);
    const double doublings = std::floor(std::log2(wanted / finestEdgeMetres(lattice)) + 0.5);
    return static_cast<int>(std::clamp(doublings, 0.0, static_cast<double>(highest)));
}

/// Number of the finest cell along an axis; empty outside the world.
std::optional<std::int64_t> cellAlong(float place, double originMetres, const Lattice& lattice) {
    const double edge = finestEdgeMetres(lattice);
    const double number = std::floor(static_cast<double>(place) / edge) - std::round(originMetres / edge);
    if (!(number >= 0 && number < std::exp2(lattice.depth))) return std::nullopt;
    return static_cast<std::int64_t>(number);
}

/// τ·2π·s²,  τ = −ln(1 − α),  s = r/2
double plainMass(const Puffs& store, std::size_t i) {
    const double tau = -std::log1p(-static_cast<double>(store.opacity[i]));
    const double s = static_cast<double>(store.radius[i]) / 2;
    return tau * 2 * std::numbers::pi * s * s;
}

/// True if `a` rather than `b` represents their voxel: the highest opacity or the lowest age; ties by lower serial.
bool comesBefore(const Puffs& store, OpacityPolicy policy, std::size_t a, std::size_t b) {
    const auto rank = [&](std::size_t i) {
        return std::pair(policy == OpacityPolicy::max ? -store.opacity[i] : store.age[i], store.serial[i]);
    };
    return rank(a) < rank(b);
}

}  // namespace

PlainOctree plainOctree(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings) {
    PlainOctree tree;
    for (std::size_t i = 0; i < store.size(); ++i) {
        const auto x = cellAlong(store.x[i], lattice.origin.x, lattice);
        const auto y = cellAlong(store.y[i], lattice.origin.y, lattice);
        const auto z = cellAlong(store.z[i], lattice.origin.z, lattice);
        if (!x || !y || !z) {
            ++tree.clipped;
            continue;
        }
        const auto index = static_cast<std::uint32_t>(i);
        const int rise = riseOf(store, i, lattice, settings);
        const auto found = tree.voxels.try_emplace({rise, *x >> rise, *y >> rise, *z >> rise}, PlainVoxel{index, 0});
        PlainVoxel& voxel = found.first->second;
        if (comesBefore(store, settings.policy, index, voxel.particle)) voxel.particle = index;
        voxel.massSquareMetres += plainMass(store, i);
    }
    return tree;
}

}  // namespace dustbench::octree
