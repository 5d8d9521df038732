// The optical depth of a cloud along every pixel's ray: the closed form, summed over the puffs.
//
// Per puff and pixel: τ·exp(−b²/2s²)·½[erf((t1 − tc)/√2s) − erf((0 − tc)/√2s)] in double precision, t1 being the scene.
// Units: metres; depth has none. Threads: uses the current oneTBB arena; same bits at any number of threads, as a row's
// sum is made by one thread in the order of the puffs; builds for other machines may differ by rounding.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/reference/camera_rays.h"
#include "bench/reference/opaque_distances.h"
#include "bench/reference/puff_list.h"

namespace dustbench::bench {

struct DepthSum {
    std::vector<double> depths;    ///< rows from the top
    std::int64_t evaluations = 0;  ///< pairs of puff and pixel that were computed
};

/// Short of the exact sum by at most what `preparePuffs` neglects, 2e-9 of a puff's depth where the puff ends clear of
/// eye and scene, and 1e-10 of it by the error function.
/// `distances` must fit the rays (checkDistances).
[[nodiscard]] DepthSum sumDepths(const std::vector<Puff>& puffs, const CameraRays& rays,
                                 const OpaqueDistances& distances);

}  // namespace dustbench::bench
