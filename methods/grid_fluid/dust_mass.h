// Rate at which the wheels raise dust: the mean optical mass that births add to the shared dust.
//
// Each puff born in a step adds the mean mass of a puff of the shared cloud at that moment; the fluid's density decays
// at 1/mean lifetime per second. Both clouds then hold the same mass, births·lifetime·mean mass, within the fluid's
// box.
// Units: m² (∫ extinction dV). Threads: pure.
#pragma once

#include "methods/contract/volume.h"

namespace dustbench::grid_fluid {

/// Mean mass of a cloud's puffs. In large clouds only every n-th puff is used.
[[nodiscard]] double meanPuffMassSquareMetres(const Puffs& dust);
/// Mean lifetime of a puff; 0 for an empty cloud.
[[nodiscard]] double meanLifetimeSeconds(const Puffs& dust);
/// Number of puffs born within the last step.
[[nodiscard]] std::size_t bornWithin(const Puffs& dust, double stepSeconds);

}  // namespace dustbench::grid_fluid
