// How one hit ages a relief.
//
// paper    the texel falls to the bottom and turns white (Bergeron, 3.4 and 4)
// scalar   the texel falls by a share of the depth (Bergeron, 3.4)
// crater   the hit removes the volume V = ½·m·(v·sin α)²/ε, α between velocity and surface (Bitter1963: deformation
//          wear without a threshold), as a paraboloid whose depth is a quarter of its radius
// deposit  the particle stays: V = m/ρ, as a paraboloid of the same form, which slides where it is too steep
//          (sliding.h)
//
// A paraboloid smaller than the texels gets a radius of 1.5 texels and keeps its volume.
//
// Units: m, kg, J. Threads: pure.
#pragma once

#include <optional>

#include "methods/contract/choices.h"
#include "methods/relief/particles/relief_particles.h"
#include "methods/relief/surface/sliding.h"
#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {

enum class AgeingModel { paper, scalar, crater, deposit };
inline constexpr Choices<AgeingModel> ageingModels{{"paper", AgeingModel::paper},
                                                   {"scalar", AgeingModel::scalar},
                                                   {"crater", AgeingModel::crater},
                                                   {"deposit", AgeingModel::deposit}};

struct AgeingSettings {
    AgeingModel model = AgeingModel::crater;
    double scalar = 0.1;                          ///< share of the depth
    double massKilograms = 0.05;                  ///< mass of a particle
    double hardnessJoulesPerCubicMetre = 1e4;     ///< ε
    double densityKilogramsPerCubicMetre = 1500;  ///< ρ of the deposit
    double reposeDegrees = 35;                    ///< angle to the face above which the deposit slides; 90: never
};

/// Returns the volume that a hit removes or deposits, before clipping at face and bottom; for crater and deposit.
[[nodiscard]] double volumeCubicMetres(const SurfaceHit& hit, const AgeingSettings& settings);

[[nodiscard]] Impact impactOf(const SurfaceHit& hit, const AgeingSettings& settings, const TexelFrame& texels,
                              double depthMetres);

/// The angle of repose of a panel's deposits; nullopt if they do not slide.
[[nodiscard]] std::optional<Repose> reposeOf(const AgeingSettings& settings, const scene::Panel& panel);

}  // namespace dustbench::relief
