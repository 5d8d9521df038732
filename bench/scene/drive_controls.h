// Controls from a drive file: its pedals, or a driver that follows its target speed.
//
// Owns: the drive and the driver. The controls of the first row hold before it, those of the last row after it.
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
