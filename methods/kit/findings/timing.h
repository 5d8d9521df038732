// The time that an experiment's work takes.
//
// Units: s. Threads: any.
#pragma once

#include <time.h>

namespace dustbench::findings {

/// Returns the calling thread's CPU time for `work`, which other programs disturb less than wall-clock time.
template <typename Work>
[[nodiscard]] double secondsOf(const Work& work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    const double begin = now();
    work();
    return now() - begin;
}

}  // namespace dustbench::findings
