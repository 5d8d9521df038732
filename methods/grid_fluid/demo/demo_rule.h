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
/// Bytes per cell: two velocities and a vector of four halves each; pressure, density, temperature and a temporary
/// scalar of one half each; a solid's velocity of four halves, and a byte that marks solids.
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

/// Returns the same settings; throws like flow::check for their box.
[[nodiscard]] inline const DemoSettings& checked(const DemoSettings& settings) {
    flow::check(settings.box);
    return settings;
}

/// The part of a fluid's settings that the demo uses; the rest is fixed. There is no wind.
[[nodiscard]] inline DemoSettings demoOf(const flow::FluidSettings& settings, bool burns) {
    return {settings.box,
            settings.sides,
            settings.forces.buoyancyPerKelvin,
            settings.forces.weightPerDensity,
            settings.forces.reactionLossPerSecond,
            burns};
}

}  // namespace dustbench::grid_fluid::demo
