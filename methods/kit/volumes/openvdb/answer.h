// How dustbench_vdb_reader answers: header by header on its standard output; then it ends.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "methods/kit/volumes/vdb_message.h"

namespace dustbench::volumes {

/// A reason for refusing the file, as one clause.
struct Refusal {
    std::string reason;
};

inline void put(const void* data, std::size_t bytes) {
    if (std::fwrite(data, 1, bytes, stdout) != bytes) _exit(1);
}

template <typename Header>
void put(const Header& header) {
    put(&header, sizeof header);
}

/// Writes the first header with the ignored parts.
inline void putMessage(VdbMessage message, const std::vector<std::string>& ignored) {
    std::string lines;
    for (const std::string& part : ignored)
        if (lines.size() + part.size() < maximumIgnoredBytes) lines += part + '\n';
    message.ignoredBytes = static_cast<std::int32_t>(lines.size());
    put(message);
    put(lines.data(), lines.size());
}

/// Ends the process without freeing the file's data.
[[noreturn]] inline void finish() {
    _exit(std::fflush(stdout) == 0 ? 0 : 1);
}

[[noreturn]] inline void writeReason(const std::string& reason) {
    VdbMessage message;
    message.reasonBytes = reason.size();
    put(message);
    put(reason.data(), reason.size());
    finish();
}

}  // namespace dustbench::volumes
