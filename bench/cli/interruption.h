// Turns Ctrl-C, `kill` and a closed terminal into a flag to poll, so that no work is left half done.
#pragma once

namespace dustbench::cli {

/// From now on these signals only set the flag.
void listenForInterruption();
[[nodiscard]] bool interrupted();

/// While it lives, these signals end the program at once with exitAborted: for work that cannot poll and writes
/// nothing.
class EndsWhenInterrupted {
 public:
    EndsWhenInterrupted();
    ~EndsWhenInterrupted() { listenForInterruption(); }
    EndsWhenInterrupted(const EndsWhenInterrupted&) = delete;
    EndsWhenInterrupted& operator=(const EndsWhenInterrupted&) = delete;
};

}  // namespace dustbench::cli
