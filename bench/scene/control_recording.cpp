#include "bench/scene/control_recording.h"

#include <set>
#include <stdexcept>

#include "bench/scene/time_step.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

namespace {

/// The times at which a drive is evaluated: k·Δt for the pedals of the step that begins there, and (k−1)·Δt + Δt for
/// the steering of the step that ends there. Rounded, they may differ, and between two rows values are interpolated.
std::set<double> timesOf(std::size_t row) {
    const auto k = static_cast<double>(row);
    return row == 0 ? std::set{0.0} : std::set{k * stepSeconds, (k - 1) * stepSeconds + stepSeconds};
}

}  // namespace

std::string ControlRecording::csv() const {
    if (steps_.empty()) throw std::logic_error("ControlRecording: no steps");
    std::string text = "time_s,throttle,brake,steer\n";
    for (std::size_t row = 0; row <= steps_.size(); ++row) {
        const Controls& begins = steps_[row < steps_.size() ? row : row - 1];
        const Controls& ends = steps_[row > 0 ? row - 1 : 0];
        for (const double time : timesOf(row)) {
            for (const double value : {time, begins.throttle, begins.brake}) text += files::csvNumber(value) + ",";
            text += files::csvNumber(ends.steer) + "\n";
        }
    }
    return text;
}

}  // namespace dustbench::bench
