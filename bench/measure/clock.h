// The clock used for all measurements, the stages of a frame measured with it, and the cost of both.
//
// Threads: the clock: any; a recorder: the one that runs the frame.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "methods/contract/stage_clock.h"

namespace dustbench::measure {

/// Nanoseconds of a steady clock, unaffected by changes to the time of day.
[[nodiscard]] std::int64_t steadyNow();

/// Age of this process, in steps of the kernel's clock tick (10 ms). Throws std::runtime_error if the kernel does not
/// report it.
[[nodiscard]] double secondsSinceProcessStart();

/// Measures the stages of a frame: each stage's own time, excluding the stages nested in it.
class StageRecorder : public StageListener {
 public:
    struct Detail {
        Stage stage;  ///< in which it was first measured
        std::string_view name;
        std::int64_t ns = 0;  ///< summed over the frame, excluding the details nested in it
    };

    explicit StageRecorder(std::function<std::int64_t()> now = steadyNow) : now_(std::move(now)) {}

    /// Called before the timestamp of each transition, so that queued work counts for the stage that queued it.
    void setFence(std::function<void()> fence) { fence_ = std::move(fence); }

    /// Discards the last frame.
    void clear();

    void begin(Stage stage) override;
    void end(Stage stage) override;
    void beginDetail(std::string_view name) override;
    void endDetail(std::string_view name) override;

    [[nodiscard]] const std::array<std::int64_t, stageNames.size()>& stageNs() const { return stageNs_; }
    /// In the order of first appearance.
    [[nodiscard]] const std::vector<Detail>& details() const { return details_; }

 private:
    std::int64_t transition(bool somethingWasQueued);
    void creditDetail(std::int64_t now);

    std::function<std::int64_t()> now_;
    std::function<void()> fence_;
    std::array<std::int64_t, stageNames.size()> stageNs_{};
    std::vector<Detail> details_;
    std::vector<Stage> openStages_;
    std::vector<std::size_t> openDetails_;
    std::int64_t stageSince_ = 0;
    std::int64_t detailSince_ = 0;
};

/// Overhead of measuring on this machine: the median of several rounds.
struct ClockCost {
    double readingNs = 0;  ///< one read of the clock
    double stageNs = 0;    ///< one stage: its begin and end, without a fence
};
[[nodiscard]] ClockCost measureClockCost();

}  // namespace dustbench::measure
