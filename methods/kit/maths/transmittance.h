// The optical model: a puff of radius r and peak opacity α is a Gaussian of extinction.
//
//     σ(x) = τ/(√(2π)·s) · exp(−|x − c|²/2s²),   s = r/2,   τ = −ln(1 − α)
//
// Units: metres, extinction per metre; optical depth is dimensionless. Threads: pure.
// Opacity follows the Beer–Lambert law. A Gaussian has a closed form for every integral along a ray.
#pragma once

#include <cmath>
#include <numbers>

namespace dustbench::maths {

/// s of a puff of radius r.
[[nodiscard]] inline double puffDeviationMetres(double radiusMetres) {
    return radiusMetres / 2;
}

/// τ: optical depth through the centre.
[[nodiscard]] inline double puffOpticalDepth(double opacity) {
    return -std::log1p(-opacity);
}

/// ∫ σ dV = τ·2π·s², in m².
[[nodiscard]] inline double puffMassSquareMetres(double opacity, double radiusMetres) {
    const double s = puffDeviationMetres(radiusMetres);
    return puffOpticalDepth(opacity) * 2 * std::numbers::pi * s * s;
}

/// σ at a distance from the centre.
[[nodiscard]] inline double puffExtinctionPerMetre(double opacity, double radiusMetres, double distanceMetres) {
    const double s = puffDeviationMetres(radiusMetres);
    return puffOpticalDepth(opacity) / (std::sqrt(2 * std::numbers::pi) * s) *
           std::exp(-distanceMetres * distanceMetres / (2 * s * s));
}

/// ∫ σ dt along a ray from t0 to t1 (distances in metres) whose closest approach to the centre is b, at distance tc:
/// τ·exp(−b²/2s²)·½·[erf((t1 − tc)/(√2·s)) − erf((t0 − tc)/(√2·s))]
[[nodiscard]] inline double rayOpticalDepth(double opacity, double radiusMetres, double b, double tc, double t0,
                                            double t1) {
    const double s = puffDeviationMetres(radiusMetres);
    const double scale = 1 / (std::numbers::sqrt2 * s);
    return puffOpticalDepth(opacity) * std::exp(-b * b / (2 * s * s)) * 0.5 *
           (std::erf((t1 - tc) * scale) - std::erf((t0 - tc) * scale));
}

/// Opacity of a billboard at distance b from its centre: α(b) = 1 − exp(−τ·exp(−b²/2s²)).
[[nodiscard]] inline double billboardOpacity(double opacity, double radiusMetres, double b) {
    const double s = puffDeviationMetres(radiusMetres);
    return -std::expm1(-puffOpticalDepth(opacity) * std::exp(-b * b / (2 * s * s)));
}

}  // namespace dustbench::maths
