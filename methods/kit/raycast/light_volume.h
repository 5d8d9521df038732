// Computes the fraction of the sun's light that arrives at each texel of a grid coarser than the one shown.
//
// Each texel contains e^(−D) at its centre, where D is the optical depth from there towards the sun.
// Units: cells of the shown grid. Owns: its memory, booked on a ledger. Threads: set() runs in parallel.
// Source: Fedkiw2001; Senger2009 refers to it for light and shadow.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/raycast/padded_cells.h"
#include "methods/kit/raycast/raycast_settings.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

/// Light reflected by a thick cloud, in linear RGB: from the sky and from the sun.
struct Reflected {
    glm::vec3 ambient{0}, sun{0};
    glm::vec3 toSun{0, 1, 0};  ///< unit vector, world
    float asymmetry = 0;       ///< of scene::phaseFactor; 0: isotropic
    [[nodiscard]] glm::vec3 all() const { return ambient + sun; }
    /// Factor of `sun` for a ray of this direction from the eye, a unit vector.
    [[nodiscard]] float phase(const glm::vec3& along) const {
        return asymmetry != 0 ? scene::phaseFactor(asymmetry, glm::dot(along, toSun)) : 1;
    }
};

class DUSTBENCH_API LightVolume {
 public:
    /// `toSun`: unit vector in world coordinates.
    LightVolume(const RaycastSettings& settings, const glm::vec3& toSun, MemoryLedger& ledger);

    /// `arriving`: share of the sun's light that reaches a point in the world through everything outside of this grid.
    /// It must vary slowly. Empty: all light arrives. Called from several threads.
    void set(const ShownGrid& grid, const std::function<float(const glm::dvec3&)>& arriving = {});

    /// The same if the grid's cells are stored elsewhere: `average` fills in the mean density of each texel, x fastest;
    /// the density of a cell is multiplied by its fire's extinction factor.
    void set(const ShownGrid& place, const std::function<void(std::span<float>)>& average,
             const std::function<float(const glm::dvec3&)>& arriving = {});

    /// Number of texels of a grid with this many cells.
    [[nodiscard]] glm::ivec3 texelsOf(const glm::ivec3& cells) const { return (cells + texelCells_ - 1) / texelCells_; }
    /// Cells along a texel's edge.
    [[nodiscard]] int texelCells() const { return texelCells_; }
    [[nodiscard]] const glm::ivec3& texels() const { return light_.cells(); }
    /// x fastest.
    [[nodiscard]] std::span<const float> values() const { return values_; }
    [[nodiscard]] const PaddedCells& padded() const { return light_; }

 private:
    void average(const ShownGrid& grid, const glm::ivec3& texels);
    void marchRow(const ShownGrid& grid, int y, int z);
    void dim(const ShownGrid& grid, const std::function<float(const glm::dvec3&)>& arriving);

    int texelCells_;
    double extinctionPerMetre_;
    glm::vec3 toSun_;
    std::vector<glm::vec4> fire_;
    LedgerVector<float> density_, values_;
    PaddedCells paddedDensity_, light_;
};

}  // namespace dustbench::raycast
