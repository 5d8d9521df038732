#include "bench/measure/memory_probe.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace dustbench::bench {

std::int64_t residentBytes() {
    std::ifstream file("/proc/self/statm");
    std::int64_t totalPages = 0, residentPages = 0;
    file >> totalPages >> residentPages;
    return residentPages * static_cast<std::int64_t>(sysconf(_SC_PAGESIZE));
}

std::int64_t peakResidentBytes() {
    // VmHWM belongs to this program's memory; ru_maxrss survives exec and would show the parent's peak.
    std::ifstream file("/proc/self/status");
    for (std::string word; file >> word;) {
        if (word != "VmHWM:") continue;
        std::int64_t kibibytes = 0;
        file >> kibibytes;
        return kibibytes * 1024;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss * 1024;
}

}  // namespace dustbench::bench
