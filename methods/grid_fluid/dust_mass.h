// How much dust the wheels raise: as much optical mass as the shared dust gains, on average, by its births.
//
// Each puff that was born in a step brings the mean mass of a puff of the shared cloud at that moment; the fluid's
// density decays by 1/mean lifetime a second. Both clouds then hold the same: births·lifetime·mean mass, as far as the
// fluid's box reaches. Units: m² (∫ extinction dV). Threads: pure.
#pragma once

#include "methods/contract/volume.h"

namespace dustbench::grid_fluid {

/// Of a cloud's puffs: a seeded sample would do, every n-th is taken where there are many.
[[nodiscard]] double meanPuffMassSquareMetres(const Puffs& dust);
/// Mean time that a puff lives; 0 of an empty cloud.
[[nodiscard]] double meanLifetimeSeconds(const Puffs& dust);
/// How many were born within the last step.
[[nodiscard]] std::size_t bornWithin(const Puffs& dust, double stepSeconds);

}  // namespace dustbench::grid_fluid
