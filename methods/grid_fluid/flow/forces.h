// Forces and sinks within a step other than pressure: buoyancy, vorticity confinement, decay, viscosity.
//
// Units: SI; temperature is relative to the air; density and reaction are dimensionless.
// Threads: slabs in blocks, each stage following the one before (for_stages.h).
// Source: Fedkiw2001, Eq. 8 (buoyancy), Eq. 11 (confinement); Senger2009, Eq. 7 (reaction).
// Departs: rates are per second, not per step; confinement is given per second, f = ε·h·(N × ω), and smoothed by
// (1, 2, 1)/4 along each axis.
#pragma once

#include <cstdint>
#include <span>

#include "methods/grid_fluid/flow/advection.h"
#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

struct ForceSettings {
    float buoyancyPerKelvin = 0.1f;  ///< upward acceleration in m/s² per kelvin
    float weightPerDensity = 0;      ///< downward acceleration in m/s² per unit of density
    float confinementPerSecond = 0;  ///< ε
    float densityDecayPerSecond = 0;
    float coolingPerSecond = 0;
    float reactionLossPerSecond = 0;  ///< k: subtracted, not proportional
    float viscosityM2PerSecond = 0;   ///< ν
};

/// Applies all forces except viscosity over a step; `cells` with ghosts, `conductance` and `moving` from SolidCells.
/// Forces are computed at the centres, and beyond the box equal those of its outermost cells; a face gets the mean of
/// its two cells. `borrowed` must have at least `forceFloats` floats.
void applyForces(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, const Moving* moving,
                 const ForceSettings& settings, float spacingMetres, float stepSeconds, std::span<float> borrowed);
[[nodiscard]] std::size_t forceFloats(const CellLayout& layout);

/// One explicit step of ∂u/∂t = ν·∇²u; `diffusion` = ν·Δt/h² must not exceed 1/6. `cells` with ghosts.
void diffuse(CellField& cells, const CellLayout& layout, const Moving* moving, float diffusion,
             std::span<float> borrowed);

}  // namespace dustbench::grid_fluid::flow
