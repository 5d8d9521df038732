// What the voxels of a set of particles are, said as plainly as can be: the oracle for all builders.
//
// Units: metres. Frame: world. Threads: pure.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include "methods/shared/octree/lattice.h"
#include "methods/shared/octree/octree_settings.h"
#include "methods/shared/particles/particle_store.h"

namespace dustbench::octree_pair {

struct OracleVoxel {
    std::uint32_t particle = 0;
    double mass = 0;
    bool taken = false;
};

/// By level above the finest, and by the cell's number at that level.
using OracleCell = std::tuple<int, std::int64_t, std::int64_t, std::int64_t>;
struct Oracle {
    std::map<OracleCell, OracleVoxel> voxels;
    std::int64_t clipped = 0;
};

inline int oracleRise(const particles::ParticleStore& store, std::size_t i, const octree::Lattice& lattice,
                      const octree::OctreeSettings& settings) {
    if (settings.levelRule == octree::LevelRule::age) {
        // In the precision of the attributes, so that a product just below a whole number is the same everywhere.
        const float levels = static_cast<float>(settings.levels);
        return std::min(settings.levels - 1, static_cast<int>(std::floor(levels * store.age[i] / store.lifetime[i])));
    }
    // The k whose edge is nearest 1.2533·r on the scale of doubling.
    const double finest = lattice.cellEdgeMetres(lattice.depth);
    const double wanted = std::sqrt(std::acos(-1.0) / 2) * static_cast<double>(store.radius[i]);
    const double doublings = std::log2(wanted / finest);
    return static_cast<int>(std::clamp(std::floor(doublings + 0.5), 0.0, static_cast<double>(settings.levels - 1)));
}

inline Oracle oracleOf(const particles::ParticleStore& store, const octree::Lattice& lattice,
                       const octree::OctreeSettings& settings) {
    Oracle oracle;
    const double finest = lattice.cellEdgeMetres(lattice.depth);
    const std::int64_t cells = std::int64_t{1} << lattice.depth;
    for (std::size_t i = 0; i < store.size(); ++i) {
        std::int64_t cell[3];
        bool inside = true;
        const float position[3] = {store.x[i], store.y[i], store.z[i]};
        for (int axis = 0; axis < 3; ++axis) {
            const double number =
                std::floor(static_cast<double>(position[axis]) / finest) - std::round(lattice.origin[axis] / finest);
            inside = inside && number >= 0 && number < static_cast<double>(cells);
            cell[axis] = inside ? static_cast<std::int64_t>(number) : 0;
        }
        if (!inside) {
            ++oracle.clipped;
            continue;
        }
        const int rise = oracleRise(store, i, lattice, settings);
        OracleVoxel& voxel = oracle.voxels[{rise, cell[0] >> rise, cell[1] >> rise, cell[2] >> rise}];
        const double tau = -std::log1p(-static_cast<double>(store.opacity[i]));
        const double s = static_cast<double>(store.radius[i]) / 2;
        voxel.mass += tau * 2 * std::acos(-1.0) * s * s;
        const auto better = [&](std::size_t a, std::size_t b) {
            const float first = settings.policy == octree::OpacityPolicy::max ? -store.opacity[a] : store.age[a];
            const float second = settings.policy == octree::OpacityPolicy::max ? -store.opacity[b] : store.age[b];
            return std::pair(first, store.serial[a]) < std::pair(second, store.serial[b]);
        };
        if (!voxel.taken || better(i, voxel.particle)) voxel.particle = static_cast<std::uint32_t>(i);
        voxel.taken = true;
    }
    return oracle;
}

}  // namespace dustbench::octree_pair
