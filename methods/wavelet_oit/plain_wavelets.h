// Haar wavelets of the optical depth A(z) along a ray: the reference implementation of wavelets.glsl and of both
// passes, in double precision, for any rank.
//
// Units: z is 0..1 from the nearest to the farthest puff. Threads: pure.
// Source: AizenshteinEtAl2022; Osorio2024.
#pragma once

#include <span>
#include <vector>

namespace dustbench::wavelet_oit {

enum class Warp { log, linear };

/// Maps distances nearest..farthest to 0..last. `last` leaves the last cell to the farthest puff alone.
struct MappedDepth {
    Warp warp = Warp::log;
    double nearestMetres = 0.1, farthestMetres = 100;
    double last = 1;

    [[nodiscard]] double at(double metres) const;
    [[nodiscard]] double slopeAt(double metres) const;
};

/// A puff's part of A. A surface: `depth` from z = `at` on, with `width` 0. A volume: a Gaussian around `centre`, width
/// √2·s in z, `whole` its depth if uncut, cut at `begin` and `end` in widths from its centre, `depth` what is left.
struct Part {
    double depth, at;
    double centre = 0, width = 0, whole = 0, begin = 0, end = 0;
};

/// ∫ A dz of a puff from in front of it to z.
[[nodiscard]] double integralTo(const Part& part, double z);

/// The 2^(rank + 1) coefficients of a puff: ∫ A, then −∫ A·ψ by level j and place k at index 2^j + k.
[[nodiscard]] std::vector<double> coefficientsOf(const Part& part, int rank);

/// Mean of A over one of as many cells as coefficients.
[[nodiscard]] double meanOver(std::span<const double> coefficients, std::size_t cell);

/// A in front of a puff, without its own part, linear between the means of two cells. A mean applies at the far end of
/// its cell; for volumes, in its middle.
[[nodiscard]] double depthBefore(std::span<const double> coefficients, const Part& own);

}  // namespace dustbench::wavelet_oit
