#include "bench/measure/machine.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <fstream>
#include <thread>

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

std::int64_t ramBytes() {
    std::ifstream file("/proc/meminfo");
    std::string name;
    std::int64_t kibibytes = 0;
    file >> name >> kibibytes;
    return name == "MemTotal:" ? kibibytes * 1024 : 0;
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
    machine.ramBytes = ramBytes();
    utsname names{};
    if (uname(&names) == 0) machine.kernel = std::string(names.sysname) + " " + names.release + " " + names.machine;
    double load = 0;
    if (getloadavg(&load, 1) == 1) machine.loadAverage = load;
    return machine;
}

std::vector<std::string> disturbances(const Machine& machine) {
    std::vector<std::string> list;
    if (!machine.governor.empty() && machine.governor != "performance")
        list.push_back(fmt::format("the CPU's frequency governor is '{}', not 'performance'", machine.governor));
    if (machine.loadAverage > 0.25 * machine.cores)
        list.push_back(
            fmt::format("the machine is busy: load average {:.2f} on {} cores", machine.loadAverage, machine.cores));
    return list;
}

}  // namespace dustbench::bench
