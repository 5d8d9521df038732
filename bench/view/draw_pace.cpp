#include "bench/view/draw_pace.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "bench/measure/statistics.h"

namespace dustbench::view {
namespace {

constexpr double limitMs = 1000 / pacedFramesPerSecond;
/// A smaller size must bring the frame below the first share of the limit, a larger one must be predicted to stay below
/// the second.
constexpr double loweredTo = 0.9, raisedBelow = 0.8;
/// A smaller size is worth its blur only if it shortens the frame by this share.
constexpr double leastGain = 0.1;

}  // namespace

void DrawPace::note(const PacedFrame& frame) {
    if (!std::isfinite(frame.wholeMs) || !(frame.wholeMs > 0)) return;
    const double draw = std::isfinite(frame.drawMs) ? std::clamp(frame.drawMs, 0.0, frame.wholeMs) : 0;
    if (frames_.size() == framesToRaise) frames_.erase(frames_.begin());
    frames_.push_back({frame.wholeMs, draw, frame.shown});
    if (frames_.size() < framesToLower) return;
    learnShown();
    if (const PacedFrame recent = medianOfLast(framesToLower); recent.wholeMs > limitMs) return go(smallerStep(recent));
    if (frames_.size() < framesToRaise || step_ == 0) return;
    if (predictedMs(medianOfLast(framesToRaise), step_ - 1) < raisedBelow * limitMs) go(step_ - 1);
}

PacedFrame DrawPace::medianOfLast(std::size_t count) const {
    std::vector<double> whole, draw, shown;
    for (const PacedFrame& frame : std::span(frames_).last(count)) {
        whole.push_back(frame.wholeMs);
        draw.push_back(frame.drawMs);
        shown.push_back(frame.shown);
    }
    return {measure::median(whole), measure::median(draw), measure::median(shown)};
}

double DrawPace::predictedMs(const PacedFrame& frame, std::size_t step) const {
    const auto pixels = [&](std::size_t of) { return shares[of] * shares[of] * (of > 0 ? shownOf(frame) : 1); };
    return frame.wholeMs - frame.drawMs + frame.drawMs * pixels(step) / pixels(step_);
}

/// The largest size that keeps the pace, or the smallest if none does; the current one if little would be gained.
std::size_t DrawPace::smallerStep(const PacedFrame& frame) const {
    std::size_t step = step_;
    while (step + 1 < shares.size() && predictedMs(frame, step) > loweredTo * limitMs) ++step;
    return predictedMs(frame, step) <= (1 - leastGain) * frame.wholeMs ? step : step_;
}

double DrawPace::shownOf(const PacedFrame& frame) const {
    return shownCost_ > 0 && frame.shown == learnedFor_ ? shownCost_ : frame.shown;
}

void DrawPace::learnShown() {
    if (step_ == 0 || !(wholeDrawMs_ > 0)) return;
    const PacedFrame recent = medianOfLast(framesToLower);
    learnedFor_ = recent.shown;
    shownCost_ = std::clamp(recent.drawMs / (wholeDrawMs_ * shares[step_] * shares[step_]), 0.01, 1.0);
    wholeDrawMs_ = 0;
}

void DrawPace::go(std::size_t step) {
    if (step == step_) return;
    if (step_ == 0) wholeDrawMs_ = medianOfLast(framesToLower).drawMs;
    step_ = step;
    frames_.clear();
}

results::ImageSize shareOf(const results::ImageSize& size, double share) {
    const auto part = [share](int pixels) { return std::max(1, static_cast<int>(std::lround(share * pixels))); };
    return {part(size.width), part(size.height)};
}

}  // namespace dustbench::view
