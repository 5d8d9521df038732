// Spreads loops over threads in fixed blocks, so that the result does not depend on the number of threads.
//
// Threads: uses the current oneTBB arena. `work` is called from several threads, once per block.
#pragma once

#include <algorithm>
#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <thread>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace dustbench::parallel {

/// Only for choices that cannot affect the result, such as how finely to split work.
[[nodiscard]] inline std::size_t threadCount() {
#ifdef __SANITIZE_THREAD__
    return 2;
#else
    return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
#endif
}

/// Runs `work(first, count)` over the blocks of 0..total: on the calling thread if there are at most `fewBlocks`
/// blocks, else in parallel.
template <typename Work>
void forEachBlock(std::size_t total, std::size_t blockSize, const Work& work, std::size_t fewBlocks = 1) {
    const auto block = [&](std::size_t b) { work(b * blockSize, std::min(blockSize, total - b * blockSize)); };
    const std::size_t blocks = (total + blockSize - 1) / blockSize;
    if (blocks <= fewBlocks) {
        for (std::size_t b = 0; b < blocks; ++b) block(b);
        return;
    }
#ifdef __SANITIZE_THREAD__
    // ThreadSanitizer cannot see into an uninstrumented oneTBB and reports false races: use plain threads instead.
    std::atomic<std::size_t> next{0};
    const auto takeBlocks = [&] {
        for (std::size_t b = next++; b < blocks; b = next++) block(b);
    };
    std::thread other(takeBlocks);
    takeBlocks();
    other.join();
#else
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t b = range.begin(); b != range.end(); ++b) block(b);
    });
#endif
}

}  // namespace dustbench::parallel
