// A copy of the volume that a method provides for one frame. Several writers use it.
//
// Units: metres, seconds, extinction per metre. Frame: world. Owns: copies.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/export/volume_settings.h"
#include "methods/contract/volume.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::exports {

struct CollectedPuff {
    glm::vec3 centre;
    float radiusMetres;
    float opacity;  ///< peak opacity α
};

struct CollectedOctree {
    glm::dvec3 originMetres;
    double edgeMetres;
    int depth;
    std::vector<OctreeVoxel> voxels;  ///< in pre-order, as specified by OctreeVolume

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

    /// Index in memory of the first cell of row (j, k).
    [[nodiscard]] std::size_t row(int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(cells.y) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(cells.x);
    }
};

/// Copies of all particles provided.
struct CollectedParticles {
    MemoryLedger ledger{};
    particles::ParticleStore all{ledger};
    std::vector<int> systems{};  ///< of each: the number of the call that provided it, from 1; empty if there was one
    int calls = 0;
    const void* source = nullptr;  ///< where the serials of the last call are
};

struct CollectedSurface {
    std::string name;
    int columns, rows;
    std::vector<glm::vec3> position, colour;
    std::vector<float> height;
    std::vector<CollectedField> fields;
};

struct CollectedTexture {
    std::string name;
    int columns, rows;
    std::vector<glm::vec4> texels;
};

class CollectedVolume final : public VolumeVisitor {
 public:
    /// Throws std::runtime_error with the particle's serial if a puff has a non-finite number.
    void puffs(const Puffs& puffs) override;
    /// Throws std::runtime_error with the voxel if it lies outside the tree or its extinction is not finite.
    void octree(const OctreeVolume& volume) override;
    /// Throws std::runtime_error with the field if its size differs from the grid's, or with the cell if a number is
    /// not finite.
    void grid(const GridVolume& volume) override;
    /// Throws std::runtime_error with surface and column if a column's size differs from the lattice's, or with the
    /// point if a number is not finite.
    void surface(const SurfaceVolume& volume) override;
    /// Throws std::runtime_error with texture and texel if its size is wrong or a number is not finite.
    void texture(const StateTexture& texture) override;

    [[nodiscard]] const std::vector<CollectedPuff>& puffs() const { return puffs_; }
    /// The particles provided; null if there were none, or only these ones.
    [[nodiscard]] const CollectedParticles* particlesUnless(const Puffs& only) const;
    [[nodiscard]] const std::vector<CollectedOctree>& octrees() const { return octrees_; }
    /// Nothing was provided, not even an empty cloud.
    [[nodiscard]] bool isNothing() const { return !particles_ && octrees_.empty() && grids_.empty(); }
    /// The cloud is exactly one octree, so it can be written as one.
    [[nodiscard]] bool isOneOctree() const { return octrees_.size() == 1 && !particles_ && grids_.empty(); }
    [[nodiscard]] const std::vector<CollectedGrid>& grids() const { return grids_; }
    /// Surfaces are not part of the cloud: `bounds` and `isNothing` ignore them.
    [[nodiscard]] const std::vector<CollectedSurface>& surfaces() const { return surfaces_; }
    /// Likewise.
    [[nodiscard]] const std::vector<CollectedTexture>& textures() const { return textures_; }
    /// Bounding box of the cloud: whole voxels, and puffs to 4s around their centres (which omits 0.006 % of a puff's
    /// mass along each axis). Empty if there is no extinction.
    [[nodiscard]] std::optional<Box> bounds() const;

 private:
    std::unique_ptr<CollectedParticles> particles_;  ///< null if none were provided, not even an empty cloud
    std::vector<CollectedPuff> puffs_;               ///< those with mass
    std::vector<CollectedOctree> octrees_;
    std::vector<CollectedGrid> grids_;
    std::vector<CollectedSurface> surfaces_;
    std::vector<CollectedTexture> textures_;
};

}  // namespace dustbench::exports
