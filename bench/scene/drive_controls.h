// Controls from a drive file: its pedal positions, or a driver who follows its target speed.
//
// The first row's controls apply before its time, the last row's after its time. Owns: the drive and the driver.
#pragma once

#include <memory>

#include "bench/scene/control_source.h"
#include "bench/scene/drive.h"
#include "bench/scene/driver.h"

namespace dustbench::bench {

class DriveControls final : public ControlSource {
 public:
    explicit DriveControls(Drive drive) : drive_(std::move(drive)) {}

    [[nodiscard]] Controls decide(const scene::VehicleParameters& parameters, const scene::VehicleState& vehicle,
                                  double nowSeconds) override;
    [[nodiscard]] double initialSpeed() const override { return drive_.followsSpeed() ? drive_.targetSpeedAt(0) : 0; }
    [[nodiscard]] double seconds() const override { return drive_.seconds(); }
    [[nodiscard]] std::unique_ptr<ControlSource> clone() const override {
        return std::make_unique<DriveControls>(*this);
    }

 private:
    Drive drive_;
    Driver driver_;
};

}  // namespace dustbench::bench
