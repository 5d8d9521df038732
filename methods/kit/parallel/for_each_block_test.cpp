#include "methods/kit/parallel/for_each_block.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <thread>
#include <vector>

namespace dustbench::parallel {
namespace {

TEST(ForEachBlock, VisitsEveryIndexOnceAtAnyNumberOfThreads) {
    for (const int threads : {1, 2, 3, 8}) {
        tbb::task_arena arena(threads);
        for (const std::size_t total : {0u, 1u, 63u, 64u, 65u, 10'000u}) {
            std::vector<int> visits(total, 0);
            arena.execute([&] {
                forEachBlock(total, 64, [&](std::size_t first, std::size_t count) {
                    EXPECT_EQ(first % 64, 0u);
                    for (std::size_t i = first; i < first + count; ++i) ++visits[i];
                });
            });
            EXPECT_EQ(visits, std::vector<int>(total, 1)) << total << " on " << threads;
        }
    }
}

TEST(ForEachBlock, SeesWhatWasWrittenBeforeAndIsSeenAfterwards) {
    // Plain memory passed into and out of the loop, mainly as a test case for ThreadSanitizer.
    std::vector<int> in(5'000), out(5'000);
    for (int round = 0; round < 50; ++round) {
        std::fill(in.begin(), in.end(), round);
        forEachBlock(in.size(), 100, [&](std::size_t first, std::size_t count) {
            for (std::size_t i = first; i < first + count; ++i) out[i] = in[i] + 1;
        });
        EXPECT_EQ(out, std::vector<int>(5'000, round + 1));
    }
}

TEST(ForEachBlock, StaysOnTheCallingThreadForFewBlocks) {
    const auto caller = std::this_thread::get_id();
    forEachBlock(
        400, 100, [&](std::size_t, std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); }, 4);
}

}  // namespace
}  // namespace dustbench::parallel
