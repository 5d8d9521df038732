// Popping: jumps from one frame to the next in a method's pictures that the reference lacks.
//
//     popping = RMS of (Iₜ − Iₜ₋₁) − (Rₜ − Rₜ₋₁)
//
// over the three display-encoded channels of all pixels with dust: α or R > 0.01 in either frame.
// Units: display-encoded values; range 0..2. Threads: pure.
#pragma once

#include <cstdint>

#include "bench/measure/image/picture.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
