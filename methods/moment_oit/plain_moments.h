// Moments of the optical depth along a ray, and the transmittance that they bound: the reference implementation of
// moments.glsl and the shaders of the transmittance, in double precision, for all kinds of moments.
//
// Units: metres; moments are of warped distances, which are in −1..1. Threads: pure.
// Source: Munstermann2018, 3. Departs: a puff's own moments, limited by eye and scene, instead of a point's; distance
// along the ray instead of along the camera's axis.
#pragma once

#include <span>
#include <vector>

#include "methods/moment_oit/moment_kind.h"

namespace dustbench::moment_oit {

enum class Warp { log, linear };

/// Maps distances nearest..farthest to −1..1.
struct WarpedDepth {
    Warp warp = Warp::log;
    double nearestMetres = 0.1, farthestMetres = 100;

    [[nodiscard]] double at(double metres) const;
    [[nodiscard]] double slopeAt(double metres) const;
};

/// A puff along a ray: τ·exp(−b²/2s²), its foot tc, s, and the eye's and the scene's distance.
struct RayPuff {
    double whole, footMetres, deviationMetres;
    double beginMetres = 0, endMetres = 1e9;
};

/// Depth, and mean and variance of the distance in metres, of the part between eye and scene.
struct Profile {
    double depth, meanMetres, varianceSquareMetres;
};
[[nodiscard]] Profile profileOf(const RayPuff& puff);

/// A surface: its optical depth and its distance.
struct RaySurface {
    double depth, metres;
};

/// b₀ … b_count of a surface.
[[nodiscard]] std::vector<double> momentsOf(const RaySurface& surface, const WarpedDepth& depth, const Kind& kind);
/// Of a puff: ∫ σ(t)·z(t)ʲ dt with z linearised at the mean distance. Trigonometric ones are those of a normal
/// distribution with the mean and the variance of the part between eye and scene.
[[nodiscard]] std::vector<double> momentsOf(const RayPuff& puff, const WarpedDepth& depth, const Kind& kind);

/// dφ/dz of the angle φ = 0 … 2π − wrappingZone of a warped distance z = −1 … 1.
inline constexpr double phaseSlope = std::numbers::pi - 0.5 * wrappingZone;
[[nodiscard]] constexpr double phaseOf(double z) {
    return (z + 1) * phaseSlope;
}

/// T(z) from b₀ … b_count: exp(−b₀·share). `share` is the weight before z, plus `overestimation` times the weight at z,
/// of the unique measure with these moments that has a point at z. With power moments, overestimation 0 and 1 give the
/// sharp upper and lower bounds of every T with these moments. With trigonometric ones, points in the wrapping zone
/// count by a ramp, as they belong to the near as much as to the far end.
/// Source: Munstermann2018, 3.2. Departs: the ramp is linear in the angle.
[[nodiscard]] double transmittance(std::span<const double> moments, double z, const Kind& kind, double bias,
                                   double overestimation);

}  // namespace dustbench::moment_oit
