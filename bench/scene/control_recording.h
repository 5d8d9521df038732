// Records the controls of a world's steps and writes them as a drive file.
//
// Played back from the same start, the file gives bit-identical controls, and so the same state hash.
#pragma once

#include <string>
#include <vector>

#include "bench/scene/vehicle_dynamics.h"

namespace dustbench::bench {

class ControlRecording {
 public:
    /// Adds the controls of the next step; the first step begins at time 0.
    void add(const Controls& controls) { steps_.push_back(controls); }
    [[nodiscard]] std::size_t steps() const { return steps_.size(); }
    /// `time_s,throttle,brake,steer`. A drive's pedals apply from the beginning of a step; its steering is the value at
    /// the end of the step. A time that rounds to two values gets two equal rows. Throws std::logic_error if nothing
    /// was recorded.
    [[nodiscard]] std::string csv() const;

 private:
    std::vector<Controls> steps_;
};

}  // namespace dustbench::bench
