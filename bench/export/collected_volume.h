// What a method handed over of one frame's cloud, kept: its parts are wanted several times.
//
// Units: metres, seconds, extinction per metre. Frame: world. Owns: copies.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/export/volume_settings.h"
#include "methods/contract/volume.h"

namespace dustbench::bench {

struct CollectedPuff {
    glm::vec3 centre;
    float radiusMetres;
    float opacity;  ///< peak opacity α
};

struct CollectedOctree {
    glm::dvec3 originMetres;
    double edgeMetres;
    int depth;
    std::vector<OctreeVoxel> voxels;  ///< in pre-order, as OctreeVolume says

    [[nodiscard]] double cellEdgeMetres(int level) const { return edgeMetres / static_cast<double>(1u << level); }
    [[nodiscard]] glm::dvec3 minimumCorner(const OctreeVoxel& voxel) const {
        return originMetres + glm::dvec3(voxel.x, voxel.y, voxel.z) * cellEdgeMetres(voxel.level);
    }
};

struct CollectedField {
    std::string name, unit;
    int components;
    std::vector<float> values;
};

struct CollectedGrid {
    glm::dvec3 originMetres;
    double spacingMetres;
    glm::ivec3 cells;
    std::vector<float> extinctionPerMetre;  ///< x fastest
    std::vector<CollectedField> fields;

    /// Over the rows (j, k) of the grid: where the row lies in memory.
    [[nodiscard]] std::size_t row(int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(cells.y) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(cells.x);
    }
};

class CollectedVolume final : public VolumeVisitor {
 public:
    /// Throws std::runtime_error with the particle's serial where a puff is not made of finite numbers.
    void puffs(const Puffs& puffs) override;
    /// Throws std::runtime_error with the voxel where it lies outside the tree or its extinction is no finite number.
    void octree(const OctreeVolume& volume) override;
    /// Throws std::runtime_error with the field where it has another size than the grid, or with the cell where a
    /// number is not finite.
    void grid(const GridVolume& volume) override;

    [[nodiscard]] const std::vector<CollectedPuff>& puffs() const { return puffs_; }
    /// The particles that were handed over last, as their owner keeps them: valid until its next step. Empty: none
    /// were.
    [[nodiscard]] const std::optional<Puffs>& particles() const { return particles_; }
    [[nodiscard]] const std::vector<CollectedOctree>& octrees() const { return octrees_; }
    /// Nothing was handed over, not even an empty cloud.
    [[nodiscard]] bool isNothing() const { return !anyPuffs_ && octrees_.empty() && grids_.empty(); }
    /// A tree can be written as a tree where it is the whole cloud.
    [[nodiscard]] bool isOneOctree() const { return octrees_.size() == 1 && !anyPuffs_ && grids_.empty(); }
    [[nodiscard]] const std::vector<CollectedGrid>& grids() const { return grids_; }
    /// What holds the cloud: voxels whole, puffs to 4s around their centres (where 0.006 % of a puff's mass is left
    /// out along each axis). None: there is no extinction anywhere.
    [[nodiscard]] std::optional<Box> bounds() const;

 private:
    bool anyPuffs_ = false;
    std::optional<Puffs> particles_;
    std::vector<CollectedPuff> puffs_;  ///< those with a mass
    std::vector<CollectedOctree> octrees_;
    std::vector<CollectedGrid> grids_;
};

}  // namespace dustbench::bench
