// The one way in which loops are spread over threads: fixed blocks, so that the result cannot depend on how many there
// are.
//
// Threads: uses the current oneTBB arena. `work` is called from several threads, once for each block.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace dustbench::parallel {

/// What oneTBB guarantees, told to ThreadSanitizer, which cannot look into a library built without it: all before the
/// loop happens before every block, and every block before all that follows. Costs nothing in other builds.
class LoopOrder {
 public:
    void loopBegins() { release(begin_); }
    void blockBegins() { acquire(begin_); }
    void blockEnds() { release(end_); }
    void loopEnds() { acquire(end_); }

 private:
#ifdef __SANITIZE_THREAD__
    static void release(char& mark) {
        __tsan_release(&mark);
    }
    static void acquire(char& mark) {
        __tsan_acquire(&mark);
    }
#else
    static void release(char&) {}
    static void acquire(char&) {}
#endif
    char begin_ = 0;
    char end_ = 0;
};

/// Runs `work(first, count)` over the blocks of 0..total: on the calling thread where there are no more than
/// `fewBlocks`, else in parallel.
template <typename Work>
void forEachBlock(std::size_t total, std::size_t blockSize, const Work& work, std::size_t fewBlocks = 1) {
    const auto block = [&](std::size_t b) { work(b * blockSize, std::min(blockSize, total - b * blockSize)); };
    const std::size_t blocks = (total + blockSize - 1) / blockSize;
    if (blocks <= fewBlocks) {
        for (std::size_t b = 0; b < blocks; ++b) block(b);
        return;
    }
    LoopOrder order;
    order.loopBegins();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks), [&](const tbb::blocked_range<std::size_t>& range) {
        order.blockBegins();
        for (std::size_t b = range.begin(); b != range.end(); ++b) block(b);
        order.blockEnds();
    });
    order.loopEnds();
}

}  // namespace dustbench::parallel
