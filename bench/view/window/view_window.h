// Opens a window, and shows a viewer in it until it is closed.
#pragma once

#include <filesystem>

#include "bench/run/executor.h"
#include "bench/view/view_state.h"

namespace dustbench::bench {

/// `folder` is where the user's files are saved, `execution` how a measurement starts its runs. Throws InputError if
/// there is no display, or none with OpenGL 4.5. Threads: the program's first, inside the oneTBB arena to be used.
void showWindow(const ViewState& state, const std::filesystem::path& folder, const ExecutionOptions& execution);

}  // namespace dustbench::bench
