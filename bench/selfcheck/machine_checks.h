// Whether this machine is fit for measurements: its clock, its processor's and GPU's speed under load.
#pragma once

#include <optional>
#include <vector>

#include "bench/measure/clock_watch.h"
#include "bench/measure/provenance.h"
#include "bench/selfcheck/check.h"

namespace dustbench::bench {

/// The resolution of the clock and one check for each disturbance that `dustbench env` reports.
[[nodiscard]] std::vector<Check> machineChecks(const Provenance& provenance);
/// Throttling of the processor between two readings.
[[nodiscard]] Check throttlingCheck(const Machine& before, const Machine& after);

struct GpuClockReadings {
    std::optional<GpuClockReading> before{}, during{}, after{};  ///< empty where the clock cannot be read
};
/// Needs attention where the clock under load is limited, or falls below the clock at rest.
[[nodiscard]] Check gpuClockCheck(const GpuClockReadings& readings);

}  // namespace dustbench::bench
