// The measurements of one recorded frame: one row of frames.csv and its rows of stages.csv.
//
// Units: in the names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "methods/contract/stage_clock.h"

namespace dustbench::measure {

struct FrameRecord {
    std::int64_t frame = 0;  ///< 0 is the first recorded frame
    double timeSeconds = 0;  ///< simulated
    double frameMs = 0;      ///< between the frame's own two timestamps, not the sum of the stages
    std::array<double, stageNames.size()> stageMs{};
    std::optional<double> gpuMs;
    std::int64_t particles = 0;
    std::int64_t primitives = 0;
    std::int64_t cpuBytes = 0;
    std::int64_t gpuBytes = 0;
    std::int64_t rssBytes = 0;

    struct Detail {
        Stage stage = Stage::build;
        std::string name;
        double ms = 0;
    };
    std::vector<Detail> details;

    /// The part of the frame outside all stages: the harness's own time.
    [[nodiscard]] double harnessMs() const {
        double rest = frameMs;
        for (const double ms : stageMs) rest -= ms;
        return rest;
    }
};

}  // namespace dustbench::measure
