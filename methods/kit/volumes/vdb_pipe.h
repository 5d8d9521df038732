// A process that reads a `.vdb`, and its output (vdb_message.h).
//
// Threads: one at a time.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace dustbench::volumes {

/// Owns: the process and our end of its output.
class VdbPipe {
 public:
    VdbPipe(pid_t process, int output) : process_(process), output_(output) {}
    ~VdbPipe() { (void)ended(); }
    VdbPipe(const VdbPipe&) = delete;
    VdbPipe& operator=(const VdbPipe&) = delete;

    /// False at the end of the output.
    [[nodiscard]] bool read(void* to, std::size_t bytes);
    /// True if no output was left and it exited with success. Waits for its end.
    [[nodiscard]] bool ended();

 private:
    pid_t process_;
    int output_;
};

/// Starts dustbench_vdb_reader with these arguments; the one that names a file is relative to this process's folder.
/// Throws std::runtime_error.
[[nodiscard]] VdbPipe startVdbReader(const std::string& first, const std::string& second);

}  // namespace dustbench::volumes
