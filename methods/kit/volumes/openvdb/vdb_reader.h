// What the program dustbench_vdb_reader does.
#pragma once

#include <cstdint>
#include <string>

namespace dustbench::volumes {

/// What reading a file of this size may take: a valid one's leaves with few values need some 50 times its size.
[[nodiscard]] std::uintmax_t vdbMemoryBytes(std::uintmax_t fileBytes);
[[nodiscard]] std::uintmax_t vdbProcessorSeconds(std::uintmax_t fileBytes);

/// For the rest of the process: memory and processor time by the file's size, no core file, no life without its parent.
/// Under sanitizers memory is not limited.
void limitVdbReader(const std::string& file);

/// The argument that is the file: FILE and FIELD, or `--points` and FILE.
[[nodiscard]] const char* vdbFile(const char* first, const char* second);

/// Writes what a file holds to the standard output (vdb_message.h) and ends the process: with 0, or as OpenVDB does.
[[noreturn]] void runVdbReader(const std::string& first, const std::string& second);

}  // namespace dustbench::volumes
