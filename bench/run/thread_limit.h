// Limits the threads of a run: oneTBB's and a software rasteriser's.
#pragma once

#include <functional>

namespace dustbench::bench {

/// Calls `work` with at most `threads` threads; 0: one per core. The limit affects the rasteriser only if OpenGL is not
/// in use yet; it overrides the environment variable `LP_NUM_THREADS`.
void withThreads(int threads, const std::function<void()>& work);

}  // namespace dustbench::bench
