// What a method hands over when it is asked what the cloud is: puffs, the voxels of an octree or the cells of a grid,
// never pictures.
//
// Units: metres, seconds, extinction per metre. Frame: world. Everything handed over is valid during the call alone.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace dustbench {

namespace particles {
class ParticleStore;
}

/// A cube of constant extinction. `level` counts from 0, the whole world, down; its edge is the world's / 2^level, its
/// least corner the world's + (x, y, z)·edge. A coarse voxel may lie over finer ones: their extinctions add up.
struct OctreeVoxel {
    std::uint32_t x, y, z;
    int level;
    float extinctionPerMetre;
    float ageSeconds;  ///< of the youngest particle that it stands for
};

/// The octree of a cloud. Voxels come in pre-order: before all that lie inside them, and the eight children of a node
/// by 4·x + 2·y + z of the half in which they lie. No two have the same cell and level.
struct OctreeVolume {
    glm::dvec3 originMetres;  ///< least corner of the world
    double edgeMetres;        ///< of the world
    int depth;                ///< the finest level
    std::span<const OctreeVoxel> voxels;
};

/// A quantity of a grid's cells, x fastest; of a vector its components side by side.
struct GridField {
    std::string_view name, unit;
    int components;  ///< 1 or 3
    std::span<const float> values;
};

/// A regular grid of cubes, each of constant extinction, with all else that is known of them.
struct GridVolume {
    glm::dvec3 originMetres;  ///< least corner
    double spacingMetres;     ///< edge of a cell
    glm::ivec3 cells;
    std::span<const float> extinctionPerMetre;
    std::span<const GridField> fields;
};

/// Who wants to know. A method calls one of the functions for each part of its cloud, usually one once.
class VolumeVisitor {
 public:
    virtual ~VolumeVisitor() = default;
    /// Gaussian puffs (maths/transmittance.h).
    virtual void puffs(const particles::ParticleStore& puffs) = 0;
    virtual void octree(const OctreeVolume& volume) = 0;
    virtual void grid(const GridVolume& volume) = 0;
};

}  // namespace dustbench
