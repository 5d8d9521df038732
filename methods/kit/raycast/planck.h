// Light of a black body by Planck's law, as a transfer function of fire: freshness gives the temperature, which gives
// colour and luminance.
//
// Units: kelvin; linear RGB. Threads: pure.
// Source: Planck1901; Wyman2013 (the eye's response, as sums of Gaussians); Senger2009, Fig. 3.
#pragma once

#include <glm/glm.hpp>

#include "methods/kit/raycast/transfer_function.h"

namespace dustbench::raycast {

/// CIE 1931 tristimulus values XYZ of a black body's spectral radiance, up to a constant factor.
[[nodiscard]] glm::dvec3 blackBody(double kelvin);

struct PlanckFire {
    double coldKelvin = 700;                            ///< at a reaction of 0
    double hotKelvin = 1800;                            ///< at a reaction of 1; linear in between
    double luminance = 3;                               ///< Rec. 709 luminance of a thick cloud at `hotKelvin`
    float burntExtinction = 1, freshExtinction = 0.4f;  ///< factors at a reaction of 0 and of 1
};

/// Channels outside of the colour space, as blue is below 1,900 K, are 0.
[[nodiscard]] TransferFunction transferFunctionOf(const PlanckFire& fire);

}  // namespace dustbench::raycast
