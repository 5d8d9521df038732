// Turns Ctrl-C, `kill` and a closed terminal into a flag to poll, so that no work is left half done.
#pragma once

namespace dustbench::cli {

/// From now on these signals only set the flag.
void listenForInterruption();
[[nodiscard]] bool interrupted();

}  // namespace dustbench::cli
