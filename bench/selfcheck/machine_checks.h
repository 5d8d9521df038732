// Whether this machine is fit for measurements: its clock, its processor's and GPU's speed under load, and whether its
// OpenGL device computes what it must, and how fast.
//
// Each check of the device draws or computes a known result and compares it with the CPU's. Faults are told apart: a
// driver that stores fewer bits fails `float targets`, one that blends in another order fails `blending order`, a wrong
// timer fails `timer queries`. Threads: the device's.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bench/measure/clock_watch.h"
#include "bench/measure/provenance.h"
#include "bench/selfcheck/selfcheck_report.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::selfcheck {

/// The resolution of the clock and one check for each disturbance that `dustbench env` reports.
[[nodiscard]] std::vector<Check> machineChecks(const measure::Provenance& provenance);
/// Throttling of the processor between two readings.
[[nodiscard]] Check throttlingCheck(const measure::Machine& before, const measure::Machine& after);

struct GpuClockReadings {
    std::optional<measure::GpuClockReading> before{}, during{}, after{};  ///< empty where the clock cannot be read
};
/// Needs attention where the clock under load is limited, or falls below the clock at rest.
[[nodiscard]] Check gpuClockCheck(const GpuClockReadings& readings);

/// Whether the device's results can be right: blending, formats, atomics, barriers, 64-bit integers, timers.
[[nodiscard]] std::vector<Check> correctnessChecks(gpu::Device& device);

/// Rates of this device. A rate is the best of three rounds of at least 20 ms each.
struct DeviceRates {
    double blendedGigapixels = 0;  ///< per second, RGBA32F, premultiplied
    double gigaflops = 0;          ///< multiplications and additions in a compute shader
    double fragmentShare = 0;      ///< speed of the same arithmetic in a fragment shader, relative to compute
    double copiedGigabytes = 0;    ///< per second, read plus written
};
/// `underLoad` is called once, while the device is busy with arithmetic.
[[nodiscard]] DeviceRates measureRates(gpu::Device& device, const std::function<void()>& underLoad);
/// One line for each rate. On hardware, slow fragment shaders need attention: frame rates there mislead.
[[nodiscard]] std::vector<Check> rateChecks(const DeviceRates& rates, bool isSoftware);

}  // namespace dustbench::selfcheck
