#include "bench/run/thread_limit.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstdlib>
#include <string>

namespace dustbench::bench {

void withThreads(int threads, const std::function<void()>& work) {
    if (threads == 0) {
        work();
        return;
    }
    // The limit includes the software rasteriser's threads, whatever the caller's environment says.
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(threads));
    oneapi::tbb::task_arena arena(threads);
    arena.execute(work);
}

}  // namespace dustbench::bench
