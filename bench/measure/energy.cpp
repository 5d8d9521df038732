#include "bench/measure/energy.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <vector>

#include "bench/measure/nvml.h"

namespace dustbench::measure {
namespace fs = std::filesystem;
namespace {

template <typename Value>
std::optional<Value> readFirst(const fs::path& file) {
    std::ifstream stream(file);
    Value value{};
    if (stream >> value) return value;
    return std::nullopt;
}

/// `intel-rapl:0` is a package, `intel-rapl:0:1` a part of one, `intel-rapl-mmio:0` the same package again.
bool isZone(const std::string& name) {
    constexpr std::string_view start = "intel-rapl:";
    return name.starts_with(start) && name.size() > start.size() &&
           std::all_of(name.begin() + start.size(), name.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// Counter of one package; it wraps to 0 at the end of its range.
struct Package {
    fs::path counter;
    std::int64_t range;
    std::int64_t last;
};

class PackageEnergy final : public EnergyCounter {
 public:
    explicit PackageEnergy(std::vector<Package> packages) : packages_(std::move(packages)) {}

    double joules() override {
        for (Package& package : packages_) {
            const auto now = readFirst<std::int64_t>(package.counter);
            if (!now) throw std::runtime_error(package.counter.string() + ": can no longer be read");
            total_ += *now >= package.last ? *now - package.last : *now - package.last + package.range + 1;
            package.last = *now;
        }
        return static_cast<double>(total_) * 1e-6;
    }

 private:
    std::vector<Package> packages_;
    std::int64_t total_ = 0;  ///< microjoules
};

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

std::unique_ptr<EnergyCounter> packageEnergy(const fs::path& powercap) {
    std::vector<Package> packages;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(powercap, error)) {
        const auto name = readFirst<std::string>(entry.path() / "name");
        if (!isZone(entry.path().filename()) || !name || !name->starts_with("package")) continue;
        const auto range = readFirst<std::int64_t>(entry.path() / "max_energy_range_uj");
        const auto now = readFirst<std::int64_t>(entry.path() / "energy_uj");
        if (!range || !now) return nullptr;  // a sum over some of the packages would be wrong
        packages.push_back({entry.path() / "energy_uj", *range, *now});
    }
    return packages.empty() ? nullptr : std::make_unique<PackageEnergy>(std::move(packages));
}

std::unique_ptr<EnergyCounter> gpuEnergy(const std::string& renderer, const std::string& library) {
    auto nvml = std::make_unique<Nvml>(library);
    const Nvml::Device device = nvml->deviceOf(renderer);
    unsigned long long now = 0;
    if (!device || !nvml->millijoules(device, now)) return nullptr;
    return std::make_unique<GpuEnergy>(std::move(nvml), device);
}

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

}  // namespace dustbench::measure
