#include "methods/kit/memory/available_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench {

std::optional<std::int64_t> bytesInKernelFile(const char* file, std::string_view name) {
    std::ifstream stream(file);
    for (std::string word; stream >> word;) {
        if (word != name) continue;
        std::int64_t kibibytes = 0;
        stream >> kibibytes;
        return kibibytes * 1024;
    }
    return std::nullopt;
}

std::int64_t availableBytes() {
    const std::int64_t machine =
        bytesInKernelFile("/proc/meminfo", "MemAvailable:").value_or(std::numeric_limits<std::int64_t>::max());
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return machine;
    const std::int64_t used = bytesInKernelFile("/proc/self/status", "VmSize:").value_or(0);
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(limit.rlim_cur) - used, 0, machine);
}

void requireAvailable(std::string_view structure, std::size_t bytes) {
    const auto available = static_cast<std::size_t>(availableBytes());
    if (bytes <= available) return;
    throw InputError("not enough memory for the " + std::string(structure) + ": " + std::to_string(bytes) +
                     " more bytes are needed, " + std::to_string(available) + " are available");
}

}  // namespace dustbench
