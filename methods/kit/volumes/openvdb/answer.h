// How dustbench_vdb_reader answers: header by header on its standard output; then it ends.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "methods/kit/volumes/field_request.h"
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

// --- A volume: the density's box, and the other fields in the same cells

/// The header that announces a field's values.
[[nodiscard]] inline VdbColumn columnOf(const WantedField& field) {
    VdbColumn column;
    field.what.copy(column.name, sizeof column.name - 1);
    column.components = field.components;
    return column;
}

/// For a `.vdb`. Throws Refusal, or what OpenVDB throws.
[[noreturn]] void answerVolume(const std::string& file, const VolumeFields& fields);
/// For a `.nvdb`, likewise.
[[noreturn]] void answerNanoVolume(const std::string& file, const VolumeFields& fields);

}  // namespace dustbench::volumes
