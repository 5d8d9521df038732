// A machine's own count of the energy that a part of it has used: CPU packages through powercap, the GPU through NVML.
//
// Where a machine does not tell there is no counter: energy is measured or missing, never estimated.
// Units: joules. Threads: one at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace dustbench::bench {

class EnergyCounter {
 public:
    virtual ~EnergyCounter() = default;
    /// Since some moment in the past; only differences mean something. Throws std::runtime_error where the machine
    /// stops telling.
    [[nodiscard]] virtual double joules() = 0;
};

/// All CPU packages together (RAPL). Null where there are none or they may not be read: since Linux 5.10 only by root.
[[nodiscard]] std::unique_ptr<EnergyCounter> packageEnergy(
    const std::filesystem::path& powercap = "/sys/class/powercap");

/// The NVIDIA GPU that `renderer` (GL_RENDERER) names. Null where NVML is not installed, the renderer is another, the
/// GPU does not count energy (before Volta), or several are called so.
[[nodiscard]] std::unique_ptr<EnergyCounter> gpuEnergy(const std::string& renderer,
                                                       const std::string& library = "libnvidia-ml.so.1");

}  // namespace dustbench::bench
