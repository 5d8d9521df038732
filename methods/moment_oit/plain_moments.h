// Moments of the optical depth along a ray, and the transmittance that they bound: the reference implementation of
// moments.glsl and transmittance.glsl, in double precision, for any even number of moments up to 6.
//
// Units: metres; moments are of warped distances, which are in −1..1. Threads: pure.
// Source: Munstermann2018, 3. Departs: a puff's own moments, limited by eye and scene, instead of a point's; distance
// along the ray instead of along the camera's axis.
#pragma once

#include <array>
#include <span>
#include <vector>

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

/// b₀..b_count of one puff: ∫ σ(t)·z(t)ʲ dt with z linearised at the mean distance; `asPoint`: depth·z(mean)ʲ.
[[nodiscard]] std::vector<double> momentsOf(const RayPuff& puff, const WarpedDepth& depth, int count, bool asPoint);

/// Bias for single precision: 5e-7 for four moments, 5e-6 for six. Source: Munstermann2018, 3.4.
[[nodiscard]] double biasOf(int count);

/// T(z) from b₀..b_count: exp(−b₀·share). `share` is the weight before z, plus `overestimation` times the weight at z,
/// of the unique measure with these moments that has a point at z. overestimation 0 and 1 give the sharp upper and
/// lower bounds of every T with these moments. Source: Munstermann2018, 3.2.
[[nodiscard]] double transmittance(std::span<const double> moments, double z, double bias, double overestimation);

}  // namespace dustbench::moment_oit
