// Tries a task that may end its process, such as loading a library, in a copy of this process.
#pragma once

#include <functional>
#include <string>

namespace dustbench::bench {

/// Returns the result of `task` from a copy of this process. If the task ends the copy, returns how it ended and its
/// last line on stderr: "a process that tried it ended by signal 11 (Segmentation fault)". SIGALRM ends the copy after
/// a minute. Call before this process starts threads. Throws std::system_error if the copy cannot be made.
[[nodiscard]] std::string triedInChild(const std::function<std::string()>& task);

}  // namespace dustbench::bench
