// The box of a fluid: its cells and the boundary condition of each of its six sides.
//
// Units: metres. Frame: world; cell (0, 0, 0) is at the minimum corner.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace dustbench::grid_fluid::flow {

enum class Side {
    open,    ///< pressure 0; inflow is clear air
    wall,    ///< impermeable
    inflow,  ///< the wind blows through at its own speed
};

/// In the order −x, +x, −y, +y, −z, +z.
using Sides = std::array<Side, 6>;

inline constexpr Sides openOverFloor{Side::open, Side::open, Side::wall, Side::open, Side::open, Side::open};
inline constexpr Sides closed{Side::wall, Side::wall, Side::wall, Side::wall, Side::wall, Side::wall};

/// Changes sides through which the wind enters to inflows; walls stay walls.
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

/// Throws InputError for a box with too few or too many cells, or an invalid spacing or position.
void check(const FluidBox& box);

}  // namespace dustbench::grid_fluid::flow
