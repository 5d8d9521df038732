// Turns Ctrl-C, `kill` and a closed terminal into a flag to poll, so that results are never left incomplete.
#pragma once

namespace dustbench::cli {

/// After this call, these signals only set the flag.
void listenForInterruption();
[[nodiscard]] bool interrupted();

/// During its lifetime, these signals end the program immediately with exitAborted. For work that cannot poll and
/// writes nothing.
class EndsWhenInterrupted {
 public:
    EndsWhenInterrupted();
    ~EndsWhenInterrupted() { listenForInterruption(); }
    EndsWhenInterrupted(const EndsWhenInterrupted&) = delete;
    EndsWhenInterrupted& operator=(const EndsWhenInterrupted&) = delete;
};

}  // namespace dustbench::cli
