// The optical depth between a point in a cloud and the sun, by the closed form.
//
// Units: metres; depth has none. Frame: world. Owns: a grid over the plane perpendicular to the sun direction; each
// cell lists the puffs that reach into it. Threads: const access from any.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>
#include "methods/contract/volume.h"

namespace dustbench::bench {

class SunDepth {
 public:
    /// τ = −ln(1 − α)·`opticalDepthShare`; a puff counts out to where its depth falls to `neglected`.
    /// `toSun` need not be a unit vector. Throws std::invalid_argument where it has no direction.
    SunDepth(const Puffs& store, const glm::dvec3& toSun, double opticalDepthShare, double neglected);

    /// Σ τ·exp(−b²/2s²)·½[1 + erf(tc/√2s)], the ray starting at `position`, in the order of the store.
    [[nodiscard]] double at(const glm::dvec3& position) const;

 private:
    /// A puff in the sun's frame, as the loop wants it: 2^(logDepth − b²·scale)·½[1 + erf(along·inverseWidth)].
    struct Entry {
        double u, v, w;
        double logDepth, scale, inverseWidth;
    };

    [[nodiscard]] int cell(double coordinate, int axis) const;

    glm::dvec3 first_, second_, toSun_;
    glm::dvec2 low_{0};
    double cellMetres_ = 1;
    glm::ivec2 cells_{0};
    std::vector<Entry> puffs_;
    std::vector<std::uint32_t> cellStart_,
        cellPuffs_;  ///< cell k's puffs: cellPuffs_[cellStart_[k]..cellStart_[k + 1])
};

}  // namespace dustbench::bench
