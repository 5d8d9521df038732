// The optical depth of a cloud along every pixel's ray: the closed form, summed over the puffs.
//
// Per puff and pixel: τ·exp(−b²/2s²)·½[erf((t1 − tc)/√2s) − erf((0 − tc)/√2s)] in double precision; t1 is the opaque
// scene.
// Units: metres; depth has none. Threads: uses the current oneTBB arena; bit-identical at any number of threads, since
// each row is summed by one thread in the order of the puffs; builds for other machines may differ by rounding.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/reference/camera_rays.h"
#include "bench/reference/puff_list.h"

namespace dustbench::reference {

struct DepthSum {
    std::vector<double> depths;    ///< rows from the top
    std::int64_t evaluations = 0;  ///< computed pairs of puff and pixel
};

/// Smaller than the exact sum by at most the depth that `preparePuffs` neglects, plus 2e-9 of a puff's depth for puffs
/// that end clear of eye and scene, plus 1e-10 of it from the error function. `distances` must fit the rays
/// (checkDistances).
[[nodiscard]] DepthSum sumDepths(const std::vector<Puff>& puffs, const CameraRays& rays,
                                 const OpaqueDistances& distances);

}  // namespace dustbench::reference
