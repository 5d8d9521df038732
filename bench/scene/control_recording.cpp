#include "bench/scene/control_recording.h"

#include <stdexcept>

#include "bench/scene/time_step.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

std::string ControlRecording::csv() const {
    if (steps_.empty()) throw std::logic_error("ControlRecording: no steps");
    std::string text = "time_s,throttle,brake,steer\n";
    for (std::size_t row = 0; row <= steps_.size(); ++row) {
        const Controls& begins = steps_[row < steps_.size() ? row : row - 1];
        const Controls& ends = steps_[row > 0 ? row - 1 : 0];
        for (const double value : {static_cast<double>(row) * stepSeconds, begins.throttle, begins.brake})
            text += files::csvNumber(value) + ",";
        text += files::csvNumber(ends.steer) + "\n";
    }
    return text;
}

}  // namespace dustbench::bench
