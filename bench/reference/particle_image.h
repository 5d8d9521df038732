// Ground truth: the picture of a cloud of puffs as it is by definition, independent of every method and of OpenGL.
//
// Along a pixel's ray the puffs' optical depths add up by the closed form (methods/kit/maths/transmittance.h), and
// α = 1 − exp(−Σ). No marching, no order, no voxels.
//   - One colour for the cloud: colour·α is exact.
//   - A colour for each particle: α is exact, the colour is integrated over slabs of the ray (see cloud_march.h), with
//   a
//     bound on its error.
// What Σ leaves out is stated in ReferenceOptions::toleratedDepth and depth_sum.h: all in all less than 1e-6 + 4e-9·Σ.
// The image is sampled at pixel centres, as OpenGL does; nothing is filtered.
//
// Units: metres; rows from the top. Colours: linear RGB, premultiplied. Threads: uses the current oneTBB arena; same
// bits at any number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/reference/opaque_distances.h"
#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

struct ReferenceOptions {
    /// Multiplies every puff's optical depth, above 0 and up to 1: 1 for the `particles` reference, 1/64 for the
    /// `continuum`, whose emitters give 64 times the particles.
    double opticalDepthShare = 1;
    /// As if the opaque scene were not there.
    bool ignoreScene = false;
    /// Upper bound, in each pixel, of the optical depth that lies beyond the edges of all footprints together.
    double toleratedDepth = 1e-6;
    /// Length of the slabs along a ray; used where each particle has a colour of its own.
    double slabMetres = 0.1;
};

struct CloudImage {
    pictures::Image image;              ///< premultiplied linear colour and alpha
    std::vector<double> opticalDepths;  ///< Σ of each pixel
    double colourErrorBound = 0;        ///< no channel of a pixel is off by more through the slabs; 0 for one colour
    std::int64_t evaluations = 0;       ///< pairs of puff and pixel that were computed

    /// 1 − exp(−Σ) of pixel (x, y), in double precision.
    [[nodiscard]] double alpha(int x, int y) const;
};

/// Throws std::runtime_error naming the serial of a particle that holds no usable number, std::invalid_argument for
/// distances that do not fit the view or hold NaN, and for options out of range.
[[nodiscard]] CloudImage renderParticles(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                                         const ReferenceOptions& options = {});

/// Throws std::invalid_argument, naming option and value.
void checkOptions(const ReferenceOptions& options);

}  // namespace dustbench::bench
