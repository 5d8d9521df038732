// Test and benchmark fixtures: clouds of random puffs and of random voxels.
#pragma once

#include <algorithm>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "bench/export/collected_volume.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::exports {

/// Owns: a store and the ledger behind it.
class TestDust {
 public:
    /// Positions within ±halfEdge of a centre off the origin, radii from `minimumRadius` to ten times that.
    TestDust(std::size_t count, float halfEdgeMetres, float minimumRadiusMetres, unsigned seed) : store(ledger_) {
        std::mt19937 random(seed);
        const auto uniform = [&random](float a, float b) {
            return std::uniform_real_distribution<float>(a, b)(random);
        };
        store.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            store.serial[i] = (std::uint64_t{1} << 40) + 3 * i;
            store.x[i] = 5 + uniform(-halfEdgeMetres, halfEdgeMetres);
            store.y[i] = 1 + uniform(-halfEdgeMetres, halfEdgeMetres);
            store.z[i] = -7 + uniform(-halfEdgeMetres, halfEdgeMetres);
            store.velocityX[i] = uniform(-3, 3);
            store.velocityY[i] = uniform(-3, 3);
            store.velocityZ[i] = uniform(-3, 3);
            store.lifetime[i] = uniform(1, 9);
            store.age[i] = uniform(0, store.lifetime[i]);
            store.radius[i] = uniform(minimumRadiusMetres, 10 * minimumRadiusMetres);
            store.opacity[i] = uniform(0.01f, 0.999f);
        }
    }

    [[nodiscard]] CollectedVolume volume() const {
        CollectedVolume volume;
        volume.puffs(store);
        return volume;
    }
    [[nodiscard]] double massSquareMetres() const {
        double sum = 0;
        for (std::size_t i = 0; i < store.size(); ++i)
            sum += maths::puffMassSquareMetres(static_cast<double>(store.opacity[i]),
                                               static_cast<double>(store.radius[i]));
        return sum;
    }

 private:
    MemoryLedger ledger_;

 public:
    particles::ParticleStore store;
};

/// In pre-order, no cell twice, coarse voxels above finer ones.
inline CollectedOctree testOctree(std::size_t count, int depth, int levels, unsigned seed) {
    std::mt19937 random(seed);
    std::set<std::tuple<std::uint64_t, int>> codes;  // Morton code of the finest cell at the corner, then the level
    for (std::size_t i = 0; i < count; ++i) {
        const int level = depth - static_cast<int>(random() % static_cast<unsigned>(levels));
        const auto coordinate = [&] { return static_cast<std::uint32_t>(random()) % (1u << level); };
        const std::uint32_t x = coordinate(), y = coordinate(), z = coordinate();
        codes.emplace(octree::mortonCode(x, y, z) << 3 * (depth - level), level);
    }
    CollectedOctree octree{{-64.5, -60, 32.25}, 128, depth, {}};
    for (const auto& [code, level] : codes) {
        const glm::uvec3 cell = octree::mortonCell(code >> 3 * (depth - level));
        octree.voxels.push_back({cell.x, cell.y, cell.z, level,
                                 std::uniform_real_distribution<float>(0.001f, 2)(random),
                                 std::uniform_real_distribution<float>(0, 9)(random)});
    }
    return octree;
}

inline double massSquareMetres(const CollectedOctree& octree) {
    double sum = 0;
    for (const OctreeVoxel& voxel : octree.voxels) {
        const double edge = octree.cellEdgeMetres(voxel.level);
        sum += static_cast<double>(voxel.extinctionPerMetre) * edge * edge * edge;
    }
    return sum;
}

inline CollectedVolume volumeOf(const CollectedOctree& octree) {
    CollectedVolume volume;
    volume.octree({octree.originMetres, octree.edgeMetres, octree.depth, octree.voxels});
    return volume;
}

/// A method's own grid of 5×4×3 cells: field n of cell c is c + 1000·n, so that swapping any two is detected.
struct TestGrid {
    TestGrid() : extinction(60), scalar(60), vector(180) {
        for (std::size_t c = 0; c < 60; ++c) {
            extinction[c] = c % 7 == 0 ? 0.0f : static_cast<float>(c);
            scalar[c] = static_cast<float>(c);
            for (std::size_t axis = 0; axis < 3; ++axis)
                vector[3 * c + axis] = static_cast<float>(c + 1000 * (axis + 1));
        }
    }
    [[nodiscard]] CollectedVolume volume() const {
        const std::array<GridField, 2> fields{{{"heat", "K", 1, scalar}, {"velocity", "m/s", 3, vector}}};
        CollectedVolume collected;
        collected.grid({{10, 20, 30}, 0.25, {5, 4, 3}, extinction, fields});
        return collected;
    }
    std::vector<float> extinction, scalar, vector;
};

}  // namespace dustbench::exports
