// The metrics of one moment, and of a run: reports/METRICS.md defines them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/measure/image/popping.h"
#include "bench/reference/judge/moment_pictures.h"

namespace dustbench::bench {

/// Every number is empty where it is not defined.
struct MomentMetrics {
    std::int64_t frame = 0;
    double timeSeconds = 0;
    std::optional<double> psnrDb, ssim, flip, flipMask, rmseLinear, psnrContinuumDb;
    std::optional<bool> identical;
    std::optional<double> popping;  ///< from the frame before
    std::optional<double> gaps, components, componentsReference, cutoff, selfSimilarity, quadsPerPixel, volumeError;
};

/// What a moment is judged by besides its pictures.
struct MomentFacts {
    std::int64_t primitives = 0;  ///< that the method handed to the GPU
    const CollectedVolume& volume;
    const CollectedVolume& referenceVolume;
    const scene::View& view;
    std::uint64_t seed = 1;
};

struct JudgedMoment {
    MomentMetrics metrics;
    pictures::Image picture;    ///< over the scene
    pictures::Image reference;  ///< over the scene
    Plane difference;           ///< FLIP's map
};

/// All but popping. `exact` with all its layers.
[[nodiscard]] JudgedMoment judgeMoment(const DrawnMoment& drawn, const ExactMoment& exact, const MomentFacts& facts);

/// Of consecutive frames.
class PoppingJudge {
 public:
    /// The next frame of the stretch; empty for its first.
    std::optional<double> add(const DrawnMoment& drawn, const ExactMoment& exact);
    [[nodiscard]] const PoppingSummary& summary() const { return summary_; }

 private:
    struct Kept {
        Picture image, reference;
        Plane alpha, referenceAlpha;
    };
    std::optional<Kept> before_;
    PoppingSummary summary_;
};

}  // namespace dustbench::bench
