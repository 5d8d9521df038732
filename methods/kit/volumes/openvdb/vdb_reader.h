// What the program dustbench_vdb_reader does.
#pragma once

#include <string>

namespace dustbench::volumes {

/// For the rest of the process: memory, processor time, no core file, no life without its parent.
void limitVdbReader();

/// Writes what a file holds to the standard output (vdb_message.h) and ends the process: with 0, or as OpenVDB does.
/// FILE and FIELD; or `--points` and FILE.
[[noreturn]] void runVdbReader(const std::string& first, const std::string& second);

}  // namespace dustbench::volumes
