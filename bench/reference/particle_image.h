// Ground truth: the reference image of a cloud of puffs, independent of all methods and of OpenGL.
//
// Along a pixel's ray the puffs' optical depths are summed by the closed form (methods/kit/maths/transmittance.h), and
// α = 1 − exp(−Σ). No marching, no sorting, no voxels.
//   - One colour for the cloud: colour·α is exact.
//   - Individual particle colours: α is exact; the colour is integrated over slabs of the ray (see cloud_march.h), with
//     a bound on its error.
// The part omitted from Σ is stated in ReferenceOptions::toleratedDepth and depth_sum.h: less than 1e-6 + 4e-9·Σ in
// total. The image is sampled at pixel centres, as in OpenGL, without filtering.
//
// Units: metres; rows from the top. Colours: linear RGB, premultiplied. Threads: uses the current oneTBB arena;
// bit-identical at any number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/reference/camera_rays.h"
#include "methods/contract/view.h"
#include "methods/contract/volume.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::reference {

struct ReferenceOptions {
    /// Multiplies every puff's optical depth, above 0 and up to 1: 1 for the `particles` reference, 1/64 for the
    /// `continuum`, whose emitters give 64 times the particles.
    double opticalDepthShare = 1;
    /// Ignores occlusion by the opaque scene.
    bool ignoreScene = false;
    /// Upper bound, in each pixel, of the total optical depth neglected beyond the edges of the footprints.
    double toleratedDepth = 1e-6;
    /// Length of the slabs along a ray; used if particles have individual colours.
    double slabMetres = 0.1;
};

struct CloudImage {
    pictures::Image image;              ///< premultiplied linear colour and alpha
    std::vector<double> opticalDepths;  ///< Σ of each pixel
    double colourErrorBound = 0;        ///< maximum error of a channel due to the slabs; 0 for one colour
    std::int64_t evaluations = 0;       ///< computed pairs of puff and pixel

    /// 1 − exp(−Σ) of pixel (x, y), in double precision.
    [[nodiscard]] double alpha(int x, int y) const;
};

/// Throws std::runtime_error with the serial of a particle that has an invalid number, std::invalid_argument for
/// distances that do not fit the view or contain NaN, and for options out of range.
[[nodiscard]] CloudImage renderParticles(const Puffs& store, const scene::View& view, const OpaqueDistances& distances,
                                         const ReferenceOptions& options = {});

/// Throws std::invalid_argument with the option and its value.
void checkOptions(const ReferenceOptions& options);

}  // namespace dustbench::reference
