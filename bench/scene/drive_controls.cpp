#include "bench/scene/drive_controls.h"

#include "bench/scene/time_step.h"

namespace dustbench::bench {

Controls DriveControls::decide(const scene::VehicleParameters& parameters, const scene::VehicleState& vehicle,
                               double nowSeconds) {
    const double next = nowSeconds + stepSeconds;
    const double steer = drive_.steerAt(next);
    if (!drive_.followsSpeed()) return {drive_.throttleAt(nowSeconds), drive_.brakeAt(nowSeconds), steer};
    return driver_.decide(parameters, vehicle, drive_.targetSpeedAt(nowSeconds), drive_.targetSpeedAt(next), steer,
                          stepSeconds);
}

}  // namespace dustbench::bench
