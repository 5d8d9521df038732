#include "bench/measure/gpu_clock.h"

#include <stdexcept>
#include <utility>

namespace dustbench::bench {
namespace {

/// Idle clocks and clocks that the user has set are not throttling.
std::string reasonsText(unsigned long long bits) {
    constexpr std::array<std::pair<unsigned long long, const char*>, 5> reasons{{{0x04, "power cap"},
                                                                                 {0x08, "hardware slowdown"},
                                                                                 {0x20, "heat"},
                                                                                 {0x40, "heat (hardware)"},
                                                                                 {0x80, "power brake"}}};
    std::string text;
    for (const auto& [bit, name] : reasons)
        if ((bits & bit) != 0) text += (text.empty() ? "" : ", ") + std::string(name);
    return text;
}

class NvmlClock final : public GpuClock {
 public:
    NvmlClock(std::unique_ptr<Nvml> nvml, Nvml::Device device) : nvml_(std::move(nvml)), device_(device) {}

    GpuClockReading read() override {
        GpuClockReading reading;
        if (!nvml_->graphicsMegahertz(device_, reading.megahertz))
            throw std::runtime_error("NVML: the GPU's clock can no longer be read");
        if (unsigned long long bits = 0; nvml_->throttleReasons(device_, bits)) reading.throttledBy = reasonsText(bits);
        return reading;
    }

 private:
    std::unique_ptr<Nvml> nvml_;
    Nvml::Device device_;
};

}  // namespace

std::unique_ptr<GpuClock> gpuClock(const std::string& renderer, const std::string& library) {
    auto nvml = std::make_unique<Nvml>(library);
    const Nvml::Device device = nvml->deviceOf(renderer);
    unsigned int now = 0;
    if (!device || !nvml->graphicsMegahertz(device, now)) return nullptr;
    return std::make_unique<NvmlClock>(std::move(nvml), device);
}

}  // namespace dustbench::bench
