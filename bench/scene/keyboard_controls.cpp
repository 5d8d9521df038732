#include "bench/scene/keyboard_controls.h"

#include <algorithm>
#include <stdexcept>

#include "bench/scene/time_step.h"

namespace dustbench::bench {

KeyboardControls::KeyboardControls(std::shared_ptr<const DrivingInput> input) : input_(std::move(input)) {
    if (!input_) throw std::invalid_argument("KeyboardControls: no input");
}

Controls KeyboardControls::decide(const scene::VehicleParameters&, const scene::VehicleState&, double nowSeconds) {
    if (nowSeconds < 0.5 * stepSeconds) return {};
    const double wanted = std::clamp(input_->steer, -1.0, 1.0);
    constexpr double limit = steerPerSecond * stepSeconds;
    steer_ += std::clamp(wanted - steer_, -limit, limit);
    return {std::clamp(input_->throttle, 0.0, 1.0), std::clamp(input_->brake, 0.0, 1.0), steer_};
}

}  // namespace dustbench::bench
