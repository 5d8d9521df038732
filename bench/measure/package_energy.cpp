#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <vector>

#include "bench/measure/energy_counter.h"

namespace dustbench::bench {
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
    constexpr std::string_view prefix = "intel-rapl:";
    return name.starts_with(prefix) && name.size() > prefix.size() &&
           std::all_of(name.begin() + prefix.size(), name.end(), [](unsigned char c) { return std::isdigit(c); });
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

}  // namespace dustbench::bench
