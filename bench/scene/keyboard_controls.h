// Controls of a vehicle that is driven live, with keys or the sticks of a gamepad.
//
// The vehicle stands until the first step of the drive, whatever keys are pressed: a drive file applies its first row
// during the preroll, so only then is a recording (control_recording.h) the same drive. Steering follows the input at a
// limited rate, so that a key can be tapped.
// Units: SI. Does not own the input, which the caller changes between steps.
#pragma once

#include <limits>
#include <memory>

#include "bench/scene/control_source.h"

namespace dustbench::bench {

/// The driver's input: throttle and brake 0..1, steering −1..1 (positive: left). Keys give 0 or ±1.
struct DrivingInput {
    double throttle = 0, brake = 0, steer = 0;
};

class KeyboardControls final : public ControlSource {
 public:
    static constexpr double steerPerSecond = 3;  ///< the whole range −1..1 is 2

    /// `input` is read at every step; not null.
    explicit KeyboardControls(std::shared_ptr<const DrivingInput> input);

    [[nodiscard]] Controls decide(const scene::VehicleParameters& parameters, const scene::VehicleState& vehicle,
                                  double nowSeconds) override;
    [[nodiscard]] double seconds() const override { return std::numeric_limits<double>::infinity(); }
    [[nodiscard]] std::unique_ptr<ControlSource> clone() const override {
        return std::make_unique<KeyboardControls>(*this);
    }

 private:
    std::shared_ptr<const DrivingInput> input_;
    double steer_ = 0;
};

}  // namespace dustbench::bench
