// Ctrl-C, `kill` and a closed terminal as something to ask for, so that nothing is left half done.
#pragma once

namespace dustbench::cli {

/// From now on these signals are only noted.
void listenForInterruption();
[[nodiscard]] bool interrupted();

}  // namespace dustbench::cli
