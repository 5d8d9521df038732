// The numbers of the published demo, in its own units: cells and steps.
//
// Source: Crane2007, 30.2; Senger2009, 4.
#pragma once

#include "methods/grid_fluid/flow/fluid_settings.h"

namespace dustbench::grid_fluid::demo {

inline constexpr int jacobiSweeps = 6;
inline constexpr float confinementOfSmoke = 0.0085f, confinementOfFire = 0.03f;  ///< per step
inline constexpr float keptOfScalars = 0.9995f;                                  ///< per step
inline constexpr float airKelvin = 293;
/// Of the fields of a cell: two velocities and a vector of four halves each; pressure, density, temperature and a
/// temporary scalar of one; a solid's velocity of four halves and whether it is there, a byte.
inline constexpr std::size_t bytesOfFlow = 32, bytesOfSolids = 9;

struct DemoSettings {
    flow::FluidBox box;
    flow::Sides sides = flow::openOverFloor;
    float buoyancyPerKelvin = 0.1f;  ///< near the air's own temperature: b·T₀²·(1/T₀ − 1/T)
    float weightPerDensity = 0;
    float reactionLossPerSecond = 0;
    bool burns = false;

    [[nodiscard]] float confinement() const { return burns ? confinementOfFire : confinementOfSmoke; }
    [[nodiscard]] float lift(float seconds) const { return buoyancyPerKelvin * seconds; }
};

/// The same settings; throws what flow::check says of their box.
[[nodiscard]] inline const DemoSettings& checked(const DemoSettings& settings) {
    flow::check(settings.box);
    return settings;
}

/// What of a fluid's settings the demo knows; the rest is its own. It has still air.
[[nodiscard]] inline DemoSettings demoOf(const flow::FluidSettings& settings, bool burns) {
    return {settings.box,
            settings.sides,
            settings.forces.buoyancyPerKelvin,
            settings.forces.weightPerDensity,
            settings.forces.reactionLossPerSecond,
            burns};
}

}  // namespace dustbench::grid_fluid::demo
