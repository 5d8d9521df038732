// How large the window draws its halves to keep 15 frames per second: a function of the times of its frames alone.
//
// Drawing is taken to cost in proportion to its pixels, and the rest of a frame to cost the same at any size:
//
//     T(s') = T − D + D·(s'/s)²
//
// What part of D does not shrink makes the prediction too low for a smaller size and too high for a larger one. So a
// size that was left for being too slow is not taken again as long as the costs stay as they are.
// Units: milliseconds; sizes are shares of width and height. Threads: pure.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bench/results/run_spec.h"

namespace dustbench::bench {

inline constexpr double pacedFramesPerSecond = 15;

/// One frame of the window.
struct PacedFrame {
    double wholeMs = 0;  ///< T
    double drawMs = 0;   ///< D, of both halves
};

class DrawPace {
 public:
    static constexpr std::array<double, 7> shares{1, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2};
    /// Frames of which medians are taken before the size gets smaller, or larger: a slow one alone changes nothing.
    static constexpr std::size_t framesToLower = 8, framesToRaise = 30;

    /// A frame that was drawn at share(). Times that are no times are ignored.
    void note(const PacedFrame& frame);
    [[nodiscard]] double share() const { return shares[step_]; }

 private:
    [[nodiscard]] PacedFrame medianOfLast(std::size_t count) const;
    [[nodiscard]] double predictedMs(const PacedFrame& frame, std::size_t step) const;
    [[nodiscard]] std::size_t smallerStep(const PacedFrame& frame) const;
    void go(std::size_t step);

    std::size_t step_ = 0;
    std::vector<PacedFrame> frames_;  ///< of this size, the last `framesToRaise`
};

/// The share of a size, at least a pixel each way.
[[nodiscard]] ImageSize shareOf(const ImageSize& size, double share);

}  // namespace dustbench::bench
