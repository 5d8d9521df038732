// What a method hands over when it is asked what the cloud is: puffs, the voxels of an octree or the cells of a grid,
// never pictures.
//
// Units: metres, metres per second, seconds, extinction per metre. Frame: world. Everything handed over is valid during
// the call alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace dustbench {

/// Gaussian puffs as a structure of arrays, an entry a particle in every column. Colours: linear RGB as seen (already
/// lit). A puff of peak opacity α and radius r has the optical depth τ = −ln(1 − α) through its centre and the
/// standard deviation r/2 (kit/maths/transmittance.h).
struct Puffs {
    std::span<const std::uint64_t> serial;  ///< unique within their system, in order of birth
    std::span<const float> x, y, z;
    std::span<const float> velocityX, velocityY, velocityZ;
    std::span<const float> age, lifetime;
    std::span<const float> radius;
    std::span<const float> opacity;           ///< peak opacity α, 0..0.999
    std::span<const float> red, green, blue;  ///< empty where all have one colour
    bool uniformColour = true;
    glm::vec3 colourOfAll{1};  ///< where all have one

    [[nodiscard]] std::size_t size() const { return serial.size(); }
    [[nodiscard]] bool empty() const { return serial.empty(); }
    [[nodiscard]] glm::vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
    [[nodiscard]] glm::vec3 colour(std::size_t i) const {
        return uniformColour ? colourOfAll : glm::vec3{red[i], green[i], blue[i]};
    }
};

/// A cube of constant extinction. `level` counts from 0, the whole world, down; its edge is the world's / 2^level, its
/// minimum corner the world's + (x, y, z)·edge. A coarse voxel may lie over finer ones: their extinctions add up.
struct OctreeVoxel {
    std::uint32_t x, y, z;
    int level;
    float extinctionPerMetre;
    float ageSeconds;  ///< of the youngest particle that it stands for
};

/// The octree of a cloud. Voxels come in pre-order: before all that lie inside them, and the eight children of a node
/// by 4·x + 2·y + z of the half in which they lie. No two have the same cell and level.
struct OctreeVolume {
    glm::dvec3 originMetres;  ///< minimum corner of the world
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
    glm::dvec3 originMetres;  ///< minimum corner
    double spacingMetres;     ///< edge of a cell
    glm::ivec3 cells;
    std::span<const float> extinctionPerMetre;
    std::span<const GridField> fields;
};

/// Who wants to know. A method calls one of the functions for each part of its cloud, usually one once.
class DUSTBENCH_API VolumeVisitor {
 public:
    virtual ~VolumeVisitor();
    virtual void puffs(const Puffs& puffs) = 0;
    virtual void octree(const OctreeVolume& volume) = 0;
    virtual void grid(const GridVolume& volume) = 0;
};

}  // namespace dustbench
