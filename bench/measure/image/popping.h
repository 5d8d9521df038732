// Popping: what jumps from one frame to the next in a method's pictures but not in the reference's.
//
//     popping = RMS of (Iₜ − Iₜ₋₁) − (Rₜ − Rₜ₋₁)
//
// over the three display-encoded channels of all pixels where there is dust: α or R > 0.01 in either frame.
// Units: display-encoded values; range 0..2. Threads: pure.
#pragma once

#include <cstdint>

#include "bench/measure/image/picture.h"

namespace dustbench::bench {

/// One moment, over the scene, and the alphas of dust alone.
struct DustFrame {
    const Picture& image;
    const Picture& reference;
    const Plane& alpha;
    const Plane& referenceAlpha;
};

/// Empty where neither frame has dust in view. The map is the root of the mean over the channels, 0 where there is no
/// dust. Throws InputError for different sizes.
[[nodiscard]] Measured popping(const DustFrame& before, const DustFrame& now);

/// The number for a run: mean and maximum over pairs of consecutive frames.
///
/// Only unbroken stretches of at least `minimumPairs` pairs count, so that a jump that comes every now and then has its
/// chance to be seen.
class PoppingSummary {
 public:
    static constexpr std::int64_t minimumPairs = 30;

    /// The next pair; an empty one (no dust in view) ends the stretch.
    void add(const std::optional<double>& pair);
    /// The next pair does not follow upon the last.
    void endStretch();

    /// Empty where no stretch is long enough.
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
