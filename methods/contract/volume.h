// A method's representation of the cloud (puffs, octree voxels or grid cells), of the surfaces that it changes and of
// the textures that hold its state; never pictures.
//
// Units: metres, metres per second, seconds, extinction per metre. Frame: world. All data passed on are valid during
// the call only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string_view>

namespace dustbench {

namespace gpu {
class Buffer;
}  // namespace gpu

/// Gaussian puffs as a structure of arrays; every column has one entry per particle. Colours: linear RGB, already lit.
/// A puff of peak opacity α and radius r has optical depth τ = −ln(1 − α) through its centre and standard deviation r/2
/// (kit/maths/transmittance.h).
struct Puffs {
    std::span<const std::uint64_t> serial;  ///< unique within their system, in order of birth
    std::span<const float> x, y, z;
    std::span<const float> velocityX, velocityY, velocityZ;
    std::span<const float> age, lifetime;
    std::span<const float> radius;
    std::span<const float> opacity;           ///< peak opacity α, 0..0.999
    std::span<const float> red, green, blue;  ///< empty if `uniformColour`
    bool uniformColour = true;
    glm::vec3 colourOfAll{1};  ///< used if `uniformColour`

    [[nodiscard]] std::size_t size() const { return serial.size(); }
    [[nodiscard]] bool empty() const { return serial.empty(); }
    [[nodiscard]] glm::vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
    [[nodiscard]] glm::vec3 colour(std::size_t i) const {
        return uniformColour ? colourOfAll : glm::vec3{red[i], green[i], blue[i]};
    }
};

/// The same in GPU buffers of 32-bit words. A column holds the values of a puff side by side, puff after puff.
struct GpuPuffs {
    const gpu::Buffer* position = nullptr;  ///< floats: x y z
    const gpu::Buffer* velocity = nullptr;  ///< floats: x y z
    const gpu::Buffer* life = nullptr;      ///< floats: age, lifetime
    const gpu::Buffer* look = nullptr;      ///< floats: radius, peak opacity
    const gpu::Buffer* serial = nullptr;    ///< unsigned: low word, high word
    const gpu::Buffer* colour = nullptr;    ///< floats: red green blue; null if all have `colourOfAll`
    /// Unsigned. Word 0: the number of puffs. Words 1 to 3: its work groups of 256, for an indirect dispatch.
    const gpu::Buffer* tally = nullptr;
    std::uint32_t bound = 0;  ///< the number, which only the GPU knows, is at most this
    glm::vec3 colourOfAll{1};
};

/// A cube of constant extinction. Level 0 is the whole world; a voxel's edge is the world's / 2^level and its minimum
/// corner is the world's + (x, y, z)·edge. A coarse voxel may overlap finer ones; their extinctions add up.
struct OctreeVoxel {
    std::uint32_t x, y, z;
    int level;
    float extinctionPerMetre;
    float ageSeconds;  ///< of the particle that represents the voxel
};

/// The octree of a cloud. Voxels come in pre-order: each before those inside it, and the eight children of a node in
/// order of octant, 4·x + 2·y + z. No two voxels share both cell and level.
struct OctreeVolume {
    glm::dvec3 originMetres;  ///< minimum corner of the world
    double edgeMetres;        ///< of the world
    int depth;                ///< the finest level
    std::span<const OctreeVoxel> voxels;
};

/// One quantity of a grid's cells, x fastest; a vector's components are interleaved.
struct GridField {
    std::string_view name, unit;
    int components;  ///< 1 or 3
    std::span<const float> values;
};

/// A regular grid of cubic cells of constant extinction, with any further fields.
struct GridVolume {
    glm::dvec3 originMetres;  ///< minimum corner
    double spacingMetres;     ///< edge of a cell
    glm::ivec3 cells;
    std::span<const float> extinctionPerMetre;
    std::span<const GridField> fields;
};

/// A surface that a method changes: a lattice of points, joined to quadrilaterals.
struct SurfaceVolume {
    std::string_view name;                ///< of the object in the scene, such as a panel; unique
    int columns, rows;                    ///< of the lattice, 2 or more each
    std::span<const glm::vec3> position;  ///< row by row; seen from its face, columns to the right and rows upwards
    std::span<const glm::vec3> colour;    ///< linear RGB
    std::span<const float> height;        ///< as in relief files: 1 at the face, 0 at full depth
    std::span<const GridField> fields;    ///< further quantities of the points
};

/// A picture of a method's state: four numbers for each texel.
struct StateTexture {
    std::string_view name;  ///< unique within the method: `wall_position`
    int columns, rows;
    std::span<const glm::vec4> texels;  ///< row by row; the method says what they mean
};

/// Receives a cloud's representation. A method calls one function for each part of its cloud, usually a single call.
class DUSTBENCH_API VolumeVisitor {
 public:
    virtual ~VolumeVisitor();
    virtual void puffs(const Puffs& puffs) = 0;
    virtual void octree(const OctreeVolume& volume) = 0;
    virtual void grid(const GridVolume& volume) = 0;
    /// The default ignores it.
    virtual void surface(const SurfaceVolume&) {}
    /// The default ignores it.
    virtual void texture(const StateTexture&) {}
};

}  // namespace dustbench
