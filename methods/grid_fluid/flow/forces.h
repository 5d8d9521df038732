// What acts on the flow within a step besides the pressure: buoyancy, vorticity confinement, decay, viscosity.
//
// Units: SI; the temperature is that above the air, density and reaction have none of their own.
// Threads: rows in blocks.
// Source: Fedkiw2001, Eq. 8 (buoyancy), Eq. 11 (confinement); Senger2009, Eq. 7 (reaction).
// Departs: rates are per second, not per step; confinement is given per second, f = ε·h·(N × ω).
#pragma once

#include <cstdint>
#include <span>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

struct ForceSettings {
    float buoyancyPerKelvin = 0.1f;  ///< upward acceleration in m/s² for each kelvin
    float weightPerDensity = 0;      ///< downward acceleration in m/s² for each unit of density
    float confinementPerSecond = 0;  ///< ε
    float densityDecayPerSecond = 0;
    float coolingPerSecond = 0;
    float reactionLossPerSecond = 0;  ///< k: taken off, not a share
    float viscosityM2PerSecond = 0;   ///< ν
};

/// Applies all forces but viscosity over a step; `cells` with ghosts. `borrowed` holds `forceFloats` at least.
void applyForces(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                 const ForceSettings& settings, float spacingMetres, float stepSeconds, std::span<float> borrowed);
[[nodiscard]] std::size_t forceFloats(const CellLayout& layout);

/// One explicit step of ∂u/∂t = ν·∇²u; `diffusion` = ν·Δt/h² must not exceed 1/6. `cells` with ghosts.
void diffuse(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, float diffusion,
             std::span<float> borrowed);

/// Curl of the velocity in 1/s and its magnitude, as four arrays of all cells, x fastest, without ghosts.
void gatherCurl(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, float spacingMetres,
                std::span<float> curl);

}  // namespace dustbench::grid_fluid::flow
