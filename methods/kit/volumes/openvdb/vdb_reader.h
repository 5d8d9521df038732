// The parts of the program dustbench_vdb_reader.
#pragma once

#include <cstdint>
#include <string>

namespace dustbench::volumes {

/// Memory limit for reading a file of this size. Leaves with few values take up to some 50 times the size of the file.
[[nodiscard]] std::uintmax_t vdbMemoryBytes(std::uintmax_t fileBytes);
[[nodiscard]] std::uintmax_t vdbProcessorSeconds(std::uintmax_t fileBytes);

/// Limits the rest of the process: memory and processor time by the file's size, no core file, and it ends with its
/// parent. Under sanitizers memory is not limited.
void limitVdbReader(const std::string& file);

/// The argument that names the file: FILE and FIELD, or `--points` and FILE.
[[nodiscard]] const char* vdbFile(const char* first, const char* second);

/// Writes a file's content to the standard output (vdb_message.h) and ends the process: with 0, or as OpenVDB does.
[[noreturn]] void runVdbReader(const std::string& first, const std::string& second);

}  // namespace dustbench::volumes
