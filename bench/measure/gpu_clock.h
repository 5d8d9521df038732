// The GPU's clock and what holds it down, by NVML.
#pragma once

#include <memory>
#include <string>

#include "bench/measure/nvml.h"

namespace dustbench::bench {

struct GpuClockReading {
    unsigned int megahertz = 0;
    std::string throttledBy{};  ///< `power cap, heat`; empty if nothing slows the clock
};

class GpuClock {
 public:
    virtual ~GpuClock() = default;
    /// Throws std::runtime_error if the clock can no longer be read.
    [[nodiscard]] virtual GpuClockReading read() = 0;
};

/// The NVIDIA GPU named by `renderer` (GL_RENDERER). Null where NVML does not report a clock for exactly one such GPU.
[[nodiscard]] std::unique_ptr<GpuClock> gpuClock(const std::string& renderer, const std::string& library = nvmlLibrary);

}  // namespace dustbench::bench
