// The optical depth between a point in a cloud and the sun in closed form, for lighting puffs.
//
// Units: metres; depth is dimensionless. Frame: world. Owns: a grid over the plane perpendicular to the sun direction;
// each cell lists the puffs that reach into it. Threads: const access from any.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/volume.h"

namespace dustbench::light {

/// Orthonormal columns: two across the sun's direction, and the direction itself. `toSun` need not be a unit vector.
/// Throws std::invalid_argument if it is zero or not finite.
[[nodiscard]] DUSTBENCH_API glm::dmat3 sunFrame(const glm::dvec3& toSun);

class DUSTBENCH_API SunDepth {
 public:
    /// τ = −ln(1 − α)·`opticalDepthShare`; a puff extends to where its depth falls to `neglected`. Puffs with values
    /// that are not finite are ignored. Throws as sunFrame() does.
    SunDepth(const Puffs& store, const glm::dvec3& toSun, double opticalDepthShare, double neglected);
    /// Only the puffs with these indices, which must ascend.
    SunDepth(const Puffs& store, const glm::dvec3& toSun, double opticalDepthShare, double neglected,
             std::span<const std::uint32_t> indices);

    /// Σ τ·exp(−b²/2s²)·½[1 + erf(tc/√2s)], the ray starting at `position`, in the order of the store.
    [[nodiscard]] double at(const glm::dvec3& position) const;

 private:
    /// A puff in the sun's frame, prepared for the loop: 2^(logDepth − b²·scale)·½[1 + erf(along·inverseWidth)].
    struct Entry {
        double u, v, w;
        double logDepth, scale, inverseWidth;
    };

    [[nodiscard]] int cell(double coordinate, int axis) const;

    glm::dmat3 frame_;  ///< sunFrame()
    glm::dvec2 low_{0};
    double cellMetres_ = 1;
    glm::ivec2 cells_{0};
    std::vector<Entry> puffs_;
    std::vector<std::uint32_t> cellStart_,
        cellPuffs_;  ///< cell k's puffs: cellPuffs_[cellStart_[k]..cellStart_[k + 1])
};

}  // namespace dustbench::light
