// The energy of the recorded frames, from hardware counters: CPU packages through powercap, the GPU through NVML.
//
// Energy is measured or missing, never estimated.
// Units: joules. Threads: one at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace dustbench::measure {

class EnergyCounter {
 public:
    virtual ~EnergyCounter() = default;
    /// Energy since an arbitrary origin; only differences are meaningful. Throws std::runtime_error if the counter can
    /// no longer be read.
    [[nodiscard]] virtual double joules() = 0;
};

/// All CPU packages together (RAPL). Null if there are none or they cannot be read; since Linux 5.10 only root can read
/// them.
[[nodiscard]] std::unique_ptr<EnergyCounter> packageEnergy(
    const std::filesystem::path& powercap = "/sys/class/powercap");

/// The NVIDIA GPU named by `renderer` (GL_RENDERER). Null if NVML is not installed, the renderer is another, the GPU
/// does not count energy (before Volta), or several GPUs have this name.
[[nodiscard]] std::unique_ptr<EnergyCounter> gpuEnergy(const std::string& renderer,
                                                       const std::string& library = "libnvidia-ml.so.1");

/// Counts while frames run, not while pictures are saved between them.
class EnergyMeter {
 public:
    /// Counters may be null: not available on this machine.
    EnergyMeter(std::unique_ptr<EnergyCounter> cpu, std::unique_ptr<EnergyCounter> gpu);

    void resume();
    void pause();

    /// Sum over all intervals between resume and pause; empty if not available on this machine.
    [[nodiscard]] std::optional<double> cpuJoules() const { return cpu_.joules(); }
    [[nodiscard]] std::optional<double> gpuJoules() const { return gpu_.joules(); }

 private:
    class Stretches {
     public:
        explicit Stretches(std::unique_ptr<EnergyCounter> counter) : counter_(std::move(counter)) {}
        void resume();
        void pause();
        [[nodiscard]] std::optional<double> joules() const;

     private:
        std::unique_ptr<EnergyCounter> counter_;
        double since_ = 0;
        double sum_ = 0;
    };

    Stretches cpu_, gpu_;
};

}  // namespace dustbench::measure
