// The simplest octree builder, for tests: looks up voxels in a map.
#pragma once

#include <map>
#include <utility>

#include "methods/kit/octree/cell_kernel.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

class MapBuilder final : public OctreeBuilder {
 public:
    std::int64_t build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                       Octree& tree) override {
        return settings.levelRule == LevelRule::age ? build<LevelRule::age>(store, lattice, settings, tree)
                                                    : build<LevelRule::radius>(store, lattice, settings, tree);
    }

 private:
    template <LevelRule levelRule>
    static std::int64_t build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                              Octree& tree) {
        const VoxelRule rule(store, settings.policy);
        const CellKernel<levelRule> kernel(store, lattice, settings);
        std::map<std::uint64_t, std::pair<CellEntry, double>> voxels;
        std::int64_t clipped = 0;
        for (std::uint32_t i = 0; i < store.size(); ++i) {
            const ParticleCell cell = kernel(i);
            if (cell.outside != 0) {
                ++clipped;
                continue;
            }
            const std::uint64_t code = static_cast<std::uint64_t>(cell.brickCode) << 12 | cell.localCode;
            const CellEntry entry(code, static_cast<int>(cell.rise), i);
            const CellEntry voxel(entry.voxelCode(), entry.rise(), i);
            auto& [winner, mass] = voxels.try_emplace(entry.place(), voxel, 0.0).first->second;
            if (rule.wins(i, winner.index())) winner = voxel;
            mass += rule.massSquareMetres(i);
        }
        tree.clear(lattice.depth);
        tree.setVoxels(voxels.size(), rule.accumulates());
        std::uint32_t k = 0;
        for (const auto& [place, found] : voxels) {
            tree.mutableVoxels()[k] = found.first;
            if (rule.accumulates()) tree.mutableMasses()[k] = found.second;
            tree.makeNode(found.first.code(), found.first.rise()).voxel = ++k;
        }
        return clipped;
    }
};

}  // namespace dustbench::octree
