// The voxels of a shape as an array, so that a particle finds its voxel in one step, and their attributes: the look and
// the motion of the particles in them.
//
// Memory: 64 bytes per voxel, active or not: force 16, colour 8, fading colour 8, size 4, fading size 4, lifetime 4,
// interpolation time 4, picture speed 4, maximum density 4, density 4, flags 4; and 4 per active voxel in the list.
// Units: m, s, linear RGB. Frame: the shape's own. Owns: its arrays, on a ledger. Threads: const members are safe from
// any. Source: JuckelBeckhaus2007, 4.1 to 4.3. Departs: opacity is the fourth colour channel; see Force.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/kit/memory/memory_ledger.h"
#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

/// The kinds of force; the paper names four and gives no formulas. With ω the force's vector, r the particle's position
/// relative to the voxel's centre, c = ω × (ω × r) and k the second number:
///     linear   acceleration ω, uniform in the voxel (m/s²)
///     orbit    acceleration −|ω|²·r: attraction to the centre; ω is the axis of the orbits of newborn particles
///     gravity  as orbit, for particles born at rest: they fall through the centre and back
///     spiral   velocity ω × r − k/|ω|·c: around the axis, r⊥ growing by the factor e^k per radian
///     helix    velocity ω × r + k·ω: around the axis and along it, k metres per radian
/// Spiral and helix turn the velocity with acceleration c and pull it, relative to the shape's, to their own. Over a
/// step each acts as a constant push, evaluated at the beginning of the step.
enum class Force : std::uint32_t { linear, orbit, spiral, helix, gravity };

/// Four numbers 0..1 in eight bytes, each rounded to the nearest of 65536 levels.
struct PackedColour {
    std::uint32_t redGreen = 0, blueOpacity = 0;

    PackedColour() = default;
    explicit PackedColour(const glm::vec4& colour)
        : redGreen(pair(colour.r, colour.g)), blueOpacity(pair(colour.b, colour.a)) {}
    [[nodiscard]] glm::vec4 colour() const {
        return glm::vec4(redGreen & 0xffffu, redGreen >> 16, blueOpacity & 0xffffu, blueOpacity >> 16) / 65535.0f;
    }

 private:
    static std::uint32_t pair(float low, float high) { return step(low) | step(high) << 16; }
    static std::uint32_t step(float share) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 65535.0f));
    }
};

/// One cache line, since a look-up needs nearly all of it.
struct alignas(64) Voxel {
    static constexpr std::uint32_t active = 1;       ///< part of the shape
    static constexpr std::uint32_t switchedOff = 2;  ///< temporarily: inside a solid
    static constexpr std::uint32_t forceShift = 8;

    glm::vec3 force{0};     ///< ω
    float forceNumber = 0;  ///< k; for a spiral k/|ω|
    PackedColour colour, fadingColour;
    float sizeMetres = 0.05f, fadingSizeMetres = 0.05f;  ///< radius of a puff
    float lifetimeSeconds = 1;                           ///< outside the shape
    float interpolationSeconds = 0;                      ///< 0: immediate
    float picturesPerSecond = 0;                         ///< of an animated texture
    std::uint32_t maximumDensity = 0;                    ///< particles
    std::uint32_t density = 0;                           ///< particles that were in it at their last look-up
    std::uint32_t flags = 0;

    [[nodiscard]] bool isActive() const { return (flags & active) != 0; }
    /// Whether it emits and keeps its particles alive.
    [[nodiscard]] bool isOn() const { return (flags & (active | switchedOff)) == active; }
    [[nodiscard]] Force forceKind() const { return static_cast<Force>(flags >> forceShift); }

    void setActive(bool on) { flags = (flags & ~(active | switchedOff)) | (on ? active : 0); }
    void setSwitchedOff(bool off) { flags = (flags & ~switchedOff) | (off ? switchedOff : 0); }
    void setForce(Force kind, const glm::vec3& vector, float number) {
        flags = (flags & 0xffu) | static_cast<std::uint32_t>(kind) << forceShift;
        force = vector;
        const float rate = glm::length(vector);
        forceNumber = kind == Force::spiral && rate > 0 ? number / rate : number;
    }
};
static_assert(sizeof(Voxel) == 64);

class VoxelGrid {
 public:
    /// Makes a grid without active voxels. Throws InputError if there is not enough memory.
    VoxelGrid(MemoryLedger& ledger, const Lattice& lattice);
    /// Makes the marked voxels active: copies of `pattern` with the marked colours.
    VoxelGrid(MemoryLedger& ledger, const MarkedVoxels& marked, const Voxel& pattern);

    [[nodiscard]] const Lattice& lattice() const { return lattice_; }
    [[nodiscard]] std::span<const Voxel> voxels() const { return voxels_; }
    [[nodiscard]] std::span<Voxel> voxels() { return voxels_; }
    [[nodiscard]] const Voxel& at(const glm::ivec3& cell) const { return voxels_[lattice_.index(cell)]; }
    [[nodiscard]] Voxel& at(const glm::ivec3& cell) { return voxels_[lattice_.index(cell)]; }

    /// Indices of the active voxels, ascending. Call `listActive` after voxels were activated or deactivated.
    [[nodiscard]] std::span<const std::uint32_t> active() const { return active_; }
    void listActive();
    /// Distributes this number of particles evenly over the active voxels as their maximum densities, and spreads the
    /// remainder. Throws InputError if no voxel is active.
    void shareOut(std::uint32_t particles);

    [[nodiscard]] std::uint64_t hash() const;

 private:
    Lattice lattice_;
    LedgerVector<Voxel> voxels_;
    LedgerVector<std::uint32_t> active_;
};

/// The direction in which the surface faces at each of `grid.active()`, away from its matter: the negative gradient of
/// the matter (active voxels and the cells they enclose) over the voxels up to two away; (0, 0, 0) if the matter is
/// symmetric.
[[nodiscard]] std::vector<glm::vec3> normalsOf(const VoxelGrid& grid);

/// The unit axis of the row at each of `grid.active()` that is part of a single row of voxels, as thin spikes are; else
/// (0, 0, 0). The component of the largest size is positive.
///
/// A row: of the active voxels that touch each other from this one to three voxels away, the centres vary across their
/// principal axis less than a tenth as much as along it.
[[nodiscard]] std::vector<glm::vec3> rowsOf(const VoxelGrid& grid);

}  // namespace dustbench::voxel_shape
