// Does what may end a process, such as loading a library, in a copy of this one first.
#pragma once

#include <functional>
#include <string>

namespace dustbench::bench {

/// What `task` returns in a copy of this process. If the copy ends in it, how, and the last line that it wrote to
/// stderr: "a process that tried it ended by signal 11 (Segmentation fault)". After a minute it ends by SIGALRM. To be
/// called before this process starts threads. Throws std::system_error if there can be no copy.
[[nodiscard]] std::string triedInChild(const std::function<std::string()>& task);

}  // namespace dustbench::bench
