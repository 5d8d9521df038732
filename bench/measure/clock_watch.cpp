#include "bench/measure/clock_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dustbench::measure {
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

constexpr std::string_view prefix = "clock fell: ";
/// Of the highest clock before it. Boost clocks move by a few steps of 15 MHz without a cause.
constexpr double tolerance = 0.05;

}  // namespace

std::unique_ptr<GpuClock> gpuClock(const std::string& renderer, const std::string& library) {
    auto nvml = std::make_unique<Nvml>(library);
    const Nvml::Device device = nvml->deviceOf(renderer);
    unsigned int now = 0;
    if (!device || !nvml->graphicsMegahertz(device, now)) return nullptr;
    return std::make_unique<NvmlClock>(std::move(nvml), device);
}

ClockWatch::ClockWatch(std::unique_ptr<GpuClock> clock, std::chrono::milliseconds interval)
    : clock_(std::move(clock)), interval_(interval) {}

void ClockWatch::betweenFrames() {
    if (!clock_ || (range_ && std::chrono::steady_clock::now() - last_ < interval_)) return;
    read();
}

void ClockWatch::end() {
    if (clock_) read();
}

void ClockWatch::read() {
    GpuClockReading reading;
    try {
        reading = clock_->read();
    } catch (const std::runtime_error&) {
        clock_.reset();
        return;
    }
    last_ = std::chrono::steady_clock::now();
    if (heldBy_.empty()) heldBy_ = reading.throttledBy;
    const unsigned int now = reading.megahertz;
    if (!range_) range_ = Range{now, now};
    range_ = Range{std::min(range_->lowest, now), std::max(range_->highest, now)};
    if (range_->highest - now > fall_.highest - fall_.lowest) fall_ = {now, range_->highest};
}

std::string ClockWatch::warning() const {
    std::string text;
    if (fall_.highest - fall_.lowest > tolerance * fall_.highest)
        text = fmt::format("{}the GPU's from {} to {} MHz", prefix, fall_.highest, fall_.lowest);
    if (heldBy_.empty()) return text;
    return text.empty() ? fmt::format("{}the GPU's is limited by {}", prefix, heldBy_)
                        : text + ", limited by " + heldBy_;
}

std::string throttlingWarning(std::int64_t eventsBefore, std::int64_t eventsAfter) {
    const std::int64_t events = eventsAfter - eventsBefore;
    if (events <= 0) return "";
    return fmt::format("{}the processor was throttled {} {} (heat)", prefix, events, events == 1 ? "time" : "times");
}

bool saysClockFell(std::string_view warning) {
    return warning.starts_with(prefix);
}

}  // namespace dustbench::measure
