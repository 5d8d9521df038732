// Trees for tests and benchmarks of ray marching, built from lists of voxels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "methods/kit/octree/octree_march.h"

namespace dustbench::octree {

struct TestVoxel {
    glm::uvec3 cell;
    int level;  ///< 1 to the depth
    float extinctionPerMetre;
    glm::vec3 colour{1};
};

class TestTree {
 public:
    explicit TestTree(const Lattice& lattice) : lattice_(lattice) {}

    /// Returns false if the voxel exists.
    bool add(const TestVoxel& voxel) {
        if (blocks_.empty()) blocks_.emplace_back();
        std::uint32_t block = 0;
        for (int level = 1;; ++level) {
            const glm::uvec3 side = voxel.cell >> glm::uvec3(static_cast<std::uint32_t>(voxel.level - level)) & 1u;
            const std::size_t octant = 4 * side.x + 2 * side.y + side.z;
            if (level == voxel.level) {
                if (blocks_[block].slots[octant].voxel > 0) return false;
                voxels_.push_back(voxel);
                extinctions_.push_back(voxel.extinctionPerMetre);
                colours_.push_back(voxel.colour);
                blocks_[block].slots[octant].voxel = static_cast<std::uint32_t>(voxels_.size());
                return true;
            }
            if (blocks_[block].slots[octant].children == 0) {
                blocks_[block].slots[octant].children = static_cast<std::uint32_t>(blocks_.size());
                blocks_.emplace_back();
            }
            block = blocks_[block].slots[octant].children;
        }
    }

    /// Valid until the next `add`.
    [[nodiscard]] MarchedTree marched(bool coloured = false) const {
        return {lattice_, blocks_, extinctions_,
                coloured ? std::span<const glm::vec3>(colours_) : std::span<const glm::vec3>()};
    }
    [[nodiscard]] const std::vector<TestVoxel>& voxels() const { return voxels_; }
    [[nodiscard]] const Lattice& lattice() const { return lattice_; }

 private:
    Lattice lattice_;
    std::vector<NodeBlock> blocks_;
    std::vector<TestVoxel> voxels_;
    std::vector<float> extinctions_;
    std::vector<glm::vec3> colours_;
};

/// The dust of a car that has driven along a curve of 60 m to x = 30 m: puffs drift, grow and thin out with age, and
/// old puffs have larger voxels.
inline TestTree trailTree(const Lattice& lattice, std::size_t voxels, int levels = 4) {
    TestTree tree(lattice);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    std::normal_distribution<double> normal;
    while (tree.voxels().size() < voxels) {
        const double age = share(random), spread = 0.4 + 2.2 * age;
        const glm::dvec3 place(30 - 60 * age + 0.5 * normal(random),
                               std::abs(0.3 + 2.5 * age + 0.7 * spread * normal(random)),
                               12 * std::sin(2.5 * age) + (share(random) < 0.5 ? -0.8 : 0.8) + spread * normal(random));
        const int level = lattice.depth - std::min(levels - 1, static_cast<int>(levels * age));
        const glm::dvec3 cell = glm::floor((place - lattice.origin) / lattice.cellEdgeMetres(level));
        const auto extinction = static_cast<float>(0.5 * std::pow(1 - age, 1.5) / lattice.cellEdgeMetres(level));
        tree.add({glm::uvec3(cell), level, extinction, glm::vec3(0.75, 0.6, 0.45)});
    }
    return tree;
}

}  // namespace dustbench::octree
