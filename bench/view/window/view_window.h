// Opens a window, and shows a viewer in it until it is closed.
#pragma once

#include <filesystem>

#include "bench/run/executor.h"
#include "bench/view/view_state.h"

namespace dustbench::bench {

/// `folder` is where the user's files are saved, `execution` how a measurement starts its runs. It looks as it did when
/// it was closed (window_settings.h). Throws InputError if there is no display, or none with OpenGL 4.5, or not with
/// the adapter that was asked for, or if the context is lost. Threads: the program's first, inside the oneTBB arena to
/// be used.
void showWindow(const ViewState& state, const std::filesystem::path& folder, const ExecutionOptions& execution);

}  // namespace dustbench::bench
