// Chooses how the window draws its halves to keep 15 frames per second, from the times of its frames alone: first only
// the visible parts, then smaller.
//
// The model: the cost of drawing is proportional to the number of pixels n, and the rest of a frame costs the same:
//
//     T(n') = T − D + D·n'/n
//
// If a part of D does not shrink, the prediction is too low for a smaller size and too high for a larger one. So a size
// that was too slow is not chosen again while the costs stay the same. Visible parts may cost less or more than their
// pixels, since dust is not everywhere: their share of D is measured when they replace whole pictures.
// Units: milliseconds; sizes are shares of width and height. Threads: pure.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bench/results/run_spec.h"

namespace dustbench::view {

inline constexpr double pacedFramesPerSecond = 15;

/// One frame of the window.
struct PacedFrame {
    double wholeMs = 0;  ///< T
    double drawMs = 0;   ///< D, of both halves
    double shown = 1;    ///< share of the halves' pixels that is shown
};

class DrawPace {
 public:
    /// The first is of whole pictures, the others of their visible parts.
    static constexpr std::array<double, 8> shares{1, 1, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2};
    /// Number of frames whose median makes the size smaller, or larger: a single slow frame changes nothing.
    static constexpr std::size_t framesToLower = 8, framesToRaise = 30;

    /// Adds a frame that was drawn as asked for. Invalid times are ignored.
    void note(const PacedFrame& frame);
    [[nodiscard]] double share() const { return shares[step_]; }
    [[nodiscard]] bool drawsOnlyShown() const { return step_ > 0; }

 private:
    [[nodiscard]] PacedFrame medianOfLast(std::size_t count) const;
    [[nodiscard]] double predictedMs(const PacedFrame& frame, std::size_t step) const;
    [[nodiscard]] std::size_t smallerStep(const PacedFrame& frame) const;
    void go(std::size_t step);
    void learnShown();
    [[nodiscard]] double shownOf(const PacedFrame& frame) const;

    std::size_t step_ = 0;
    double wholeDrawMs_ = 0;          ///< D of whole pictures when they became too slow; 0: it is used
    double learnedFor_ = 0;           ///< PacedFrame::shown of the frames behind `shownCost_`
    double shownCost_ = 0;            ///< share of D that visible parts took; 0: not known
    std::vector<PacedFrame> frames_;  ///< at this size, at most the last `framesToRaise`
};

/// The share of a size, at least a pixel each way.
[[nodiscard]] results::ImageSize shareOf(const results::ImageSize& size, double share);

}  // namespace dustbench::view
