#include "methods/shared/particles/parts/stream.h"

#include <cmath>

namespace dustbench::particles {

PartInfo Stream::describe() {
    PartInfo info{PartKind::emission, "stream", "a steady stream, faster with the vehicle's speed", {}, {}};
    info.parameters.real("rate_per_second", 0, 0, 1e8, "1/s", "births per second, from all emitters together")
        .real("rate_per_metre", 40, 0, 1e6, "1/m", "births per metre that the vehicle goes, besides");
    return info;
}

Stream::Stream(const ParameterValues& values)
    : EmissionPart("stream", values),
      ratePerSecond_(values.real("rate_per_second")),
      ratePerMetre_(values.real("rate_per_metre")) {}

Births Stream::births(const Step& step) {
    const double speed = step.scene.vehicle ? step.state.vehicle.speed : 0;
    const double ratePerPuff =
        step.fixedRatePerSecond > 0 ? step.fixedRatePerSecond : ratePerSecond_ + ratePerMetre_ * std::abs(speed);
    const double rate = ratePerPuff * static_cast<double>(step.particlesPerPuff);
    if (rate <= 0) return {};
    const double due = carried_ + rate * step.seconds;
    const double whole = std::floor(due);
    const Births births{static_cast<std::int64_t>(whole), (1 - carried_) / rate, 1 / rate};
    carried_ = due - whole;
    return births;
}

}  // namespace dustbench::particles
