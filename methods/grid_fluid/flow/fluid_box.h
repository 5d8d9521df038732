// The box that a fluid fills: its cells, and what lies beyond each of its six sides.
//
// Units: metres. Frame: world; cell (0, 0, 0) is the one at the minimum corner.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace dustbench::grid_fluid::flow {

enum class Side {
    open,    ///< pressure 0; what flows in is clear air
    wall,    ///< nothing passes
    inflow,  ///< the wind blows through, at its own speed
};

/// In the order −x, +x, −y, +y, −z, +z.
using Sides = std::array<Side, 6>;

inline constexpr Sides openOverFloor{Side::open, Side::open, Side::wall, Side::open, Side::open, Side::open};
inline constexpr Sides closed{Side::wall, Side::wall, Side::wall, Side::wall, Side::wall, Side::wall};

/// Sides through which a wind enters become inflows; walls stay walls.
[[nodiscard]] Sides withWind(Sides sides, const glm::vec3& windMetresPerSecond);

struct FluidBox {
    glm::ivec3 cells{128, 64, 64};
    double spacingMetres = 0.1;  ///< edge of a cell
    glm::dvec3 originMetres{0};  ///< minimum corner

    [[nodiscard]] std::size_t cellCount() const {
        return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
               static_cast<std::size_t>(cells.z);
    }
};

/// Throws InputError where a box has too few or too many cells, no spacing, or no place.
void check(const FluidBox& box);

}  // namespace dustbench::grid_fluid::flow
