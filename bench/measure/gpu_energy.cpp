#include <dlfcn.h>

#include <array>
#include <stdexcept>

#include "bench/measure/energy_counter.h"

namespace dustbench::bench {
namespace {

/// The parts of NVIDIA's management library that are needed here. It comes with the driver and is loaded at run time.
class Nvml {
 public:
    using Device = void*;

    explicit Nvml(const std::string& file) : library_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
        if (!library_) return;
        find(init_, "nvmlInit_v2");
        find(shutdown_, "nvmlShutdown");
        find(count_, "nvmlDeviceGetCount_v2");
        find(handle_, "nvmlDeviceGetHandleByIndex_v2");
        find(name_, "nvmlDeviceGetName");
        find(energy_, "nvmlDeviceGetTotalEnergyConsumption");
        works_ = complete_ && init_() == success;
    }
    ~Nvml() {
        if (works_) shutdown_();
        if (library_) dlclose(library_);
    }
    Nvml(const Nvml&) = delete;
    Nvml& operator=(const Nvml&) = delete;

    /// The only device whose name the renderer contains; null if there is none or more than one.
    [[nodiscard]] Device deviceOf(const std::string& renderer) const {
        unsigned int devices = 0;
        if (!works_ || count_(&devices) != success) return nullptr;
        Device found = nullptr;
        for (unsigned int index = 0; index < devices; ++index) {
            Device device = nullptr;
            std::array<char, 96> name{};
            if (handle_(index, &device) != success || name_(device, name.data(), name.size()) != success)
                return nullptr;
            if (name[0] == '\0' || renderer.find(name.data()) == std::string::npos) continue;
            if (found) return nullptr;
            found = device;
        }
        return found;
    }

    [[nodiscard]] bool millijoules(Device device, unsigned long long& value) const {
        return energy_(device, &value) == success;
    }

 private:
    static constexpr int success = 0;

    template <typename Function>
    void find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(library_, name));
        complete_ = complete_ && function != nullptr;
    }

    void* library_;
    bool complete_ = true;
    bool works_ = false;
    int (*init_)() = nullptr;
    int (*shutdown_)() = nullptr;
    int (*count_)(unsigned int*) = nullptr;
    int (*handle_)(unsigned int, Device*) = nullptr;
    int (*name_)(Device, char*, unsigned int) = nullptr;
    int (*energy_)(Device, unsigned long long*) = nullptr;
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

std::unique_ptr<EnergyCounter> gpuEnergy(const std::string& renderer, const std::string& library) {
    auto nvml = std::make_unique<Nvml>(library);
    const Nvml::Device device = nvml->deviceOf(renderer);
    unsigned long long now = 0;
    if (!device || !nvml->millijoules(device, now)) return nullptr;
    return std::make_unique<GpuEnergy>(std::move(nvml), device);
}

}  // namespace dustbench::bench
