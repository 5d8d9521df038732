// Sunlight that reaches a point in a cloud of several grids, through all of them but one.
//
// Each grid is stored as means over blocks of cells; a ray to the sun takes steps of one block. Units: metres,
// extinction per metre. Frame: world. Owns: the means. Threads: `arrivingAt` may be called from several.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::grid_fluid {

class CloudShade {
 public:
    static constexpr int block = 4;  ///< cells

    /// `toSun`: unit vector.
    CloudShade(const glm::vec3& toSun, double extinctionPerMetre) : toSun_(toSun), extinction_(extinctionPerMetre) {}

    /// Identifies a grid.
    using Id = std::array<int, 3>;

    /// Adds or replaces a grid. All have the same spacing.
    void set(const Id& id, const raycast::ShownGrid& grid);
    /// Moves a grid and sets the remaining share of its original density.
    void change(const Id& id, const glm::dvec3& originMetres, double share);
    void remove(const Id& id) { grids_.erase(id); }
    /// Share of the sunlight that passes all grids but this one.
    [[nodiscard]] float arrivingAt(const glm::dvec3& place, const Id& without) const;

 private:
    struct Blocks {
        glm::dvec3 minimum;
        glm::ivec3 count;
        std::vector<float> mean;
        double share = 1;
    };
    glm::dvec3 toSun_;
    double extinction_, blockMetres_ = 0;
    std::map<Id, Blocks> grids_;
};

}  // namespace dustbench::grid_fluid
