// Opens a window and shows a viewer in it until it is closed.
#pragma once

#include <filesystem>

#include "bench/run/executor.h"
#include "bench/view/view_state.h"

namespace dustbench::view {

/// Saves the user's files in `folder`; `execution` defines how a measurement starts its runs. The window looks as it
/// did when it was last closed (window_settings.h). Throws InputError if there is no display, no OpenGL 4.5 or not the
/// requested adapter, or if the context is lost. Threads: the program's first, inside the oneTBB arena to be used.
void showWindow(const ViewState& state, const std::filesystem::path& folder, const run::ExecutionOptions& execution);

}  // namespace dustbench::view
