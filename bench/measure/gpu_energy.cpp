#include <stdexcept>

#include "bench/measure/energy_counter.h"
#include "bench/measure/nvml.h"

namespace dustbench::bench {
namespace {

class GpuEnergy final : public EnergyCounter {
 public:
    GpuEnergy(std::unique_ptr<Nvml> nvml, Nvml::Device device) : nvml_(std::move(nvml)), device_(device) {}

    double joules() override {
        unsigned long long millijoules = 0;
        if (!nvml_->millijoules(device_, millijoules))
            throw std::runtime_error("NVML: the GPU's energy can no longer be read");
        return static_cast<double>(millijoules) * 1e-3;
    }

 private:
    std::unique_ptr<Nvml> nvml_;
    Nvml::Device device_;
};

}  // namespace

std::unique_ptr<EnergyCounter> gpuEnergy(const std::string& renderer, const std::string& library) {
    auto nvml = std::make_unique<Nvml>(library);
    const Nvml::Device device = nvml->deviceOf(renderer);
    unsigned long long now = 0;
    if (!device || !nvml->millijoules(device, now)) return nullptr;
    return std::make_unique<GpuEnergy>(std::move(nvml), device);
}

}  // namespace dustbench::bench
