// Prepares the particles of a store for the ground truth: validates them and computes Gaussians of extinction in the
// camera's frame, each with its footprint.
//
// Units: metres; optical depth has none. Frame: camera axes (see camera_rays.h). Threads: pure.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "bench/reference/camera_rays.h"
#include "methods/contract/volume.h"

namespace dustbench::reference {

/// Along a ray, a puff is cut off at this many s from its centre: ½·erfc(6/√2) = 1e-9 of its depth lies beyond.
inline constexpr double sigmasAlongRay = 6;

struct Puff {
    glm::dvec3 centre;
    double deviationMetres;  ///< s = r/2
    double opticalDepth;     ///< τ through the centre
    double reachMetres;      ///< R: rays that pass at a greater distance are unaffected
    int firstRow, endRow;    ///< rows of the image that its footprint may touch
    std::uint32_t index;     ///< in the store
};

/// Minimum depth at which a puff still counts, so that the total neglected depth stays below `toleratedDepth`.
[[nodiscard]] double neglectedDepth(double toleratedDepth, std::size_t puffs);

/// In store order, without puffs that do not affect the image (no opacity, no radius, behind the camera, out of view).
/// τ = −ln(1 − α)·`opticalDepthShare`. R = s·√(2·ln(τ/`neglected`)): there τ·exp(−R²/2s²) = `neglected`. Throws
/// std::runtime_error with the particle's serial if a position, radius or opacity is not finite, the radius is
/// negative, or the opacity is outside [0, 1).
[[nodiscard]] std::vector<Puff> preparePuffs(const Puffs& store, const CameraRays& rays, double opticalDepthShare,
                                             double neglected);

/// The columns [first, end) of row `y` that a puff may touch, widened by less than a pixel; empty if first == end.
struct Columns {
    int first, end;
};

/// Geometry of a puff for the rays through column slopes X of one row. The ray runs along (X, Y, 1), and the squared
/// length of centre × (X, Y, 1) is γ·(X − X0)² + κ; divided by D = 1 + X² + Y², it is b². Avoids cancellation.
struct RowGeometry {
    double gamma, x0, kappa;
    double footAtZero, footPerSlope;  ///< centre · (X, Y, 1) = footAtZero + footPerSlope·X = tc·√D
};
[[nodiscard]] RowGeometry rowGeometry(const Puff& puff, double slopeY);

[[nodiscard]] Columns columnsOf(const Puff& puff, const RowGeometry& row, double slopeY, const CameraRays& rays);

}  // namespace dustbench::reference
