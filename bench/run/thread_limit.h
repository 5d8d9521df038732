// How many threads a run may use: oneTBB's and a software rasteriser's.
#pragma once

#include <functional>

namespace dustbench::bench {

/// Calls `work` with at most so many threads; 0: as many as there are cores. The rasteriser's number holds only where
/// OpenGL is not yet in use.
void withThreads(int threads, const std::function<void()>& work);

}  // namespace dustbench::bench
