#include "bench/measure/machine.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <fstream>
#include <thread>

#include "methods/kit/memory/available_memory.h"

namespace dustbench::bench {
namespace {

std::string firstLine(const char* file) {
    std::string line;
    std::ifstream stream(file);
    std::getline(stream, line);
    return line;
}

std::string cpuModel() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) {
            const auto colon = line.find(": ");
            if (colon != std::string::npos) return line.substr(colon + 2);
        }
    return {};
}

bool hasHypervisor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("flags")) return (line + " ").find(" hypervisor ") != std::string::npos;
    return false;
}

/// The eighth number of the first line is steal time: the machine was runnable but the host did not run it.
double stolenShareSinceBoot() {
    std::ifstream file("/proc/stat");
    std::string name;
    file >> name;
    double sum = 0, stolen = 0, ticks = 0;
    for (int field = 1; field <= 8 && file >> ticks; ++field) {
        sum += ticks;
        stolen = field == 8 ? ticks : 0;
    }
    return sum > 0 ? stolen / sum : 0;
}

/// CPU quota of a container, from cgroups version 2 or 1.
double quotaCores() {
    std::string quota;
    double allowed = 0, period = 0;
    if (std::ifstream file("/sys/fs/cgroup/cpu.max"); file >> quota >> period && quota != "max")
        allowed = std::strtod(quota.c_str(), nullptr);
    else if (std::ifstream older("/sys/fs/cgroup/cpu/cpu.cfs_quota_us"); older >> allowed)
        std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_period_us") >> period;
    return allowed > 0 && period > 0 ? allowed / period : 0;
}

int usableCores() {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
    return static_cast<int>(std::thread::hardware_concurrency());
}

}  // namespace

Machine readMachine() {
    Machine machine;
    machine.cpu = cpuModel();
    machine.governor = firstLine("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
    machine.cores = usableCores();
    machine.ramBytes = bytesInKernelFile("/proc/meminfo", "MemTotal:").value_or(0);
    utsname names{};
    if (uname(&names) == 0) machine.kernel = std::string(names.sysname) + " " + names.release + " " + names.machine;
    double load = 0;
    if (getloadavg(&load, 1) == 1) machine.loadAverage = load;
    machine.virtualMachine = hasHypervisor();
    machine.stolenShare = stolenShareSinceBoot();
    machine.quotaCores = quotaCores();
    std::ifstream("/sys/devices/system/cpu/cpu0/thermal_throttle/core_throttle_count") >> machine.throttled;
    return machine;
}

std::vector<std::string> disturbances(const Machine& machine) {
    std::vector<std::string> list;
    const auto add = [&list](std::string sentence) { list.push_back(std::move(sentence)); };
    if (!machine.governor.empty() && machine.governor != "performance")
        add(
            fmt::format("the CPU's frequency governor is '{}', not 'performance' (as root: cpupower frequency-set -g "
                        "performance)",
                        machine.governor));
    if (machine.loadAverage > 0.25 * machine.cores)
        add(fmt::format("the machine is busy: load average {:.2f} on {} cores (stop other programs and wait a minute)",
                        machine.loadAverage, machine.cores));
    if (machine.quotaCores > 0 && machine.quotaCores < machine.cores)
        add(
            fmt::format("the container may use {:.2f} cores but sees {} (assign whole cores: --cpuset-cpus "
                        "instead of --cpus)",
                        machine.quotaCores, machine.cores));
    if (machine.stolenShare > 0.005)
        add(
            fmt::format("the host has taken {:.1f} % of this virtual machine's CPU time since boot (use a machine that "
                        "is not shared, or more repetitions)",
                        100 * machine.stolenShare));
    if (machine.throttled > 0)
        add(
            fmt::format("the CPU has been throttled {} times since boot (improve the cooling, or set cooldown_s in "
                        "the suite)",
                        machine.throttled));
    return list;
}

}  // namespace dustbench::bench
