// NVIDIA's management library (NVML), as far as it is needed here. It comes with the driver and is loaded at run time.
//
// Owns: the loaded library. Threads: one at a time.
#pragma once

#include <dlfcn.h>

#include <array>
#include <string>

namespace dustbench::measure {

inline constexpr const char* nvmlLibrary = "libnvidia-ml.so.1";

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
        findIfThere(clock_, "nvmlDeviceGetClockInfo");
        findIfThere(throttling_, "nvmlDeviceGetCurrentClocksThrottleReasons");
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

    /// Each returns false if the GPU, or this version of the library, does not report the value.
    [[nodiscard]] bool millijoules(Device device, unsigned long long& value) const {
        return energy_(device, &value) == success;
    }

    [[nodiscard]] bool graphicsMegahertz(Device device, unsigned int& value) const {
        constexpr int graphics = 0;  // NVML_CLOCK_GRAPHICS
        return clock_ && clock_(device, graphics, &value) == success;
    }
    /// A bit for each reason, as in `nvmlClocksThrottleReasons…`.
    [[nodiscard]] bool throttleReasons(Device device, unsigned long long& value) const {
        return throttling_ && throttling_(device, &value) == success;
    }

 private:
    static constexpr int success = 0;

    template <typename Function>
    void findIfThere(Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(library_, name));
    }
    template <typename Function>
    void find(Function& function, const char* name) {
        findIfThere(function, name);
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
    int (*clock_)(Device, int, unsigned int*) = nullptr;
    int (*throttling_)(Device, unsigned long long*) = nullptr;
};

}  // namespace dustbench::measure
