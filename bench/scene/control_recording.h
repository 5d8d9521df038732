// The controls of a world's steps, kept as they come, as the drive file that repeats them.
//
// Played from the same start, the file gives the same controls to the last bit, and so the same state hash.
#pragma once

#include <string>
#include <vector>

#include "bench/scene/vehicle_dynamics.h"

namespace dustbench::bench {

class ControlRecording {
 public:
    /// Of the next step, the first from time 0 on.
    void add(const Controls& controls) { steps_.push_back(controls); }
    [[nodiscard]] std::size_t steps() const { return steps_.size(); }
    /// `time_s,throttle,brake,steer`. A drive's pedals count from the beginning of a step, its steering is what the
    /// step ends with. Throws std::logic_error where nothing was recorded.
    [[nodiscard]] std::string csv() const;

 private:
    std::vector<Controls> steps_;
};

}  // namespace dustbench::bench
