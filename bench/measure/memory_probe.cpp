#include "bench/measure/memory_probe.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace dustbench::bench {
namespace {

/// A line `NAME: 123 kB` of one of the kernel's files; `otherwise` where it has none.
std::int64_t bytesOf(const char* file, std::string_view name, std::int64_t otherwise) {
    std::ifstream stream(file);
    for (std::string word; stream >> word;) {
        if (word != name) continue;
        std::int64_t kibibytes = 0;
        stream >> kibibytes;
        return kibibytes * 1024;
    }
    return otherwise;
}

}  // namespace

std::int64_t residentBytes() {
    std::ifstream file("/proc/self/statm");
    std::int64_t totalPages = 0, residentPages = 0;
    file >> totalPages >> residentPages;
    return residentPages * static_cast<std::int64_t>(sysconf(_SC_PAGESIZE));
}

std::int64_t peakResidentBytes() {
    // VmHWM belongs to this program's memory; ru_maxrss survives exec and would show the parent's peak.
    if (const std::int64_t bytes = bytesOf("/proc/self/status", "VmHWM:", 0); bytes > 0) return bytes;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss * 1024;
}

std::int64_t availableBytes() {
    const std::int64_t machine = bytesOf("/proc/meminfo", "MemAvailable:", std::numeric_limits<std::int64_t>::max());
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return machine;
    const std::int64_t own = static_cast<std::int64_t>(limit.rlim_cur) - bytesOf("/proc/self/status", "VmSize:", 0);
    return std::clamp<std::int64_t>(own, 0, machine);
}

}  // namespace dustbench::bench
