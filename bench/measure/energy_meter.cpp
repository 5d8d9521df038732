#include "bench/measure/energy_meter.h"

namespace dustbench::bench {

EnergyMeter::EnergyMeter(std::unique_ptr<EnergyCounter> cpu, std::unique_ptr<EnergyCounter> gpu)
    : cpu_(std::move(cpu)), gpu_(std::move(gpu)) {}

void EnergyMeter::resume() {
    cpu_.resume();
    gpu_.resume();
}

void EnergyMeter::pause() {
    cpu_.pause();
    gpu_.pause();
}

void EnergyMeter::Stretches::resume() {
    if (counter_) since_ = counter_->joules();
}

void EnergyMeter::Stretches::pause() {
    if (counter_) sum_ += counter_->joules() - since_;
}

std::optional<double> EnergyMeter::Stretches::joules() const {
    return counter_ ? std::optional(sum_) : std::nullopt;
}

}  // namespace dustbench::bench
