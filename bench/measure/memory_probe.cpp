#include "bench/measure/memory_probe.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

#include "methods/kit/memory/available_memory.h"

namespace dustbench::measure {

std::int64_t residentBytes() {
    std::ifstream file("/proc/self/statm");
    std::int64_t totalPages = 0, residentPages = 0;
    file >> totalPages >> residentPages;
    return residentPages * static_cast<std::int64_t>(sysconf(_SC_PAGESIZE));
}

std::int64_t peakResidentBytes() {
    // VmHWM is this program's own peak; ru_maxrss survives exec and would show the parent's.
    if (const auto bytes = bytesInKernelFile("/proc/self/status", "VmHWM:")) return *bytes;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss * 1024;
}

}  // namespace dustbench::measure
