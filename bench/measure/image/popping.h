// Popping: jumps from one frame to the next in a method's pictures that the reference lacks.
//
//     popping = RMS of (Iₜ − Iₜ₋₁) − (Rₜ − Rₜ₋₁)
//
// over the three display-encoded channels of all pixels with dust: α or R > 0.01 in either frame; over a run, and
// separately for small and large primitives.
// Units: display-encoded values; range 0..2. Threads: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bench/measure/image/picture.h"

namespace dustbench::measure {

/// One frame: the pictures over the scene, and the alphas of the dust alone.
struct DustFrame {
    const Picture& image;
    const Picture& reference;
    const Plane& alpha;
    const Plane& referenceAlpha;
};

/// Empty if neither frame has dust in view. The map is the RMS over the channels, 0 where there is no dust. Throws
/// InputError if the sizes differ.
[[nodiscard]] Measured popping(const DustFrame& before, const DustFrame& now);

/// Whether a pixel counts: α or R > 0.01 in either frame.
[[nodiscard]] bool hasDust(const DustFrame& before, const DustFrame& now, std::size_t pixel);

/// Popping over a run: mean and maximum over pairs of consecutive frames.
///
/// Only uninterrupted stretches of at least `minimumPairs` pairs count, so that occasional jumps are likely to be
/// included.
class PoppingSummary {
 public:
    static constexpr std::int64_t minimumPairs = 30;

    /// Adds the next pair. An empty one (no dust in view) ends the stretch.
    void add(const std::optional<double>& pair);
    /// Ends the stretch: the next pair does not follow the last.
    void endStretch();

    /// Empty if no stretch is long enough.
    [[nodiscard]] std::optional<double> mean() const;
    [[nodiscard]] std::optional<double> maximum() const;

 private:
    struct Stretch {
        std::int64_t pairs = 0;
        double sum = 0, maximum = 0;
    };
    [[nodiscard]] Stretch counted() const;

    Stretch ended_, current_;
};

// --- Popping of small and of large primitives separately, within one picture: whether large voxels pop more than small
// ones, and which of them contribute more to the popping of the picture.
//
// A primitive is large if it is larger, in metres, than the geometric mean of the smallest and the largest one. A pixel
// belongs to the side whose primitives have more optical depth there, summed over the two frames. A primitive
// contributes depth·exp(−2b²/r²) within 1.5 r, the extent of a drawn quad, whether the scene hides it or not.
//
//     small, large            popping over the pixels of that side only: how much they jump
//     small_part, large_part  √(Σ jump² over the side's pixels / number of pixels with dust): the contribution of
//                             the side to popping. Distant primitives cover few pixels, so this weights by distance.
//                             small_part² + large_part² = popping², except for dust that no primitive reaches

struct SizedPrimitive {
    ScreenPrimitive place;
    double sizeMetres = 0;
    double opticalDepth = 0;  ///< through its centre
};

/// Optical depth of small and of large primitives at each pixel.
struct SizeDepths {
    Plane small, large;
};

/// Empty if all primitives have the same size within 1 %, or there are none.
[[nodiscard]] std::optional<SizeDepths> largeAmong(std::span<const SizedPrimitive> primitives, int width, int height);

/// Empty for a side that has no pixel with dust.
struct PoppingBySize {
    std::optional<double> small, large, smallPart, largePart;
};

/// Throws InputError if the sizes of the pictures differ.
[[nodiscard]] PoppingBySize poppingBySize(const DustFrame& before, const DustFrame& now, const SizeDepths& depthsBefore,
                                          const SizeDepths& depthsNow);

}  // namespace dustbench::measure
