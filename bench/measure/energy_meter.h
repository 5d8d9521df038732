// The energy of the recorded frames: counted while they run, not while pictures are saved between them.
//
// Units: joules. Threads: one at a time.
#pragma once

#include <memory>
#include <optional>

#include "bench/measure/energy_counter.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
