#include "methods/kit/parallel/for_stages.h"

#include <gtest/gtest.h>

#include <mutex>
#include <vector>

namespace dustbench::parallel {
namespace {

TEST(ForStages, EachFindsItsNeighboursOneStageBehindAndNoneAhead) {
    for (const std::size_t slabs : {1u, 2u, 3u, 7u, 16u, 33u, 64u})
        for (const std::size_t stages : {1u, 2u, 3u, 5u, 9u})
            for (const std::size_t blocks : {1u, 2u, 3u, 8u}) {
                std::vector<std::size_t> done(slabs, 0);  // number of stages done, by slab
                std::mutex mutex;
                forStages(slabs, stages, blocks, [&](std::size_t stage, std::size_t slab) {
                    const std::lock_guard lock(mutex);
                    ASSERT_LT(slab, slabs);
                    EXPECT_EQ(done[slab], stage);
                    // The neighbours have done the previous stage, and none that overwrites the input of this one.
                    for (const std::size_t neighbour : {slab - 1, slab + 1})
                        if (neighbour < slabs) {
                            EXPECT_GE(done[neighbour], stage) << slabs << " slabs, stage " << stage << " of " << stages;
                            EXPECT_LE(done[neighbour], stage + 1);
                        }
                    ++done[slab];
                });
                EXPECT_EQ(done, std::vector<std::size_t>(slabs, stages));
            }
}

}  // namespace
}  // namespace dustbench::parallel
