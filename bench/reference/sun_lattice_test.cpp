#include "bench/reference/sun_lattice.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "bench/reference/test_clouds.h"

namespace dustbench::reference {
namespace {

using particles::ParticleStore;

const glm::dvec3 lowSun(-0.93, 0.26, -0.25);

/// Points in and around a trail, and up to 30 m behind it as the sun sees it.
glm::dvec3 pointBy(std::uint64_t k) {
    const auto a = maths::uniform4(8, 9, k);
    return glm::dvec3(-45 + 55 * static_cast<double>(a[0]), -1 + 6 * static_cast<double>(a[1]),
                      8 * static_cast<double>(maths::centred(a[2]))) -
           (k % 4 == 0 ? 30 * static_cast<double>(a[3]) : 0) * glm::normalize(lowSun);
}

TEST(SunLattice, IsTheClosedFormToAThousandthInATrail) {
    MemoryLedger ledger;
    const ParticleStore store = test::trail(ledger, 3000, 60);
    const SunLattice lattice(store, lowSun, 1, 1e-9, 1);
    const light::SunDepth exact(store, lowSun, 1, 1e-9);
    EXPECT_GT(lattice.nodes(), 0u);
    double worst = 0, deepest = 0;
    for (std::uint64_t k = 0; k < 20000; ++k) {
        const glm::dvec3 at = pointBy(k);
        deepest = std::max(deepest, exact.at(at));
        worst = std::max(worst, std::abs(lattice.at(at) - exact.at(at)));
    }
    EXPECT_GT(deepest, 0.5);
    EXPECT_LT(worst, 1e-3);
}

TEST(SunLattice, ASinglePuffsErrorIsWithinItsBound) {
    MemoryLedger ledger;
    ParticleStore store(ledger);
    test::add(store, {1, 2, 3}, 1, 0.5f);
    for (const glm::dvec3 toSun : {glm::dvec3(0, 1, 0), lowSun}) {
        const SunLattice lattice(store, toSun, 1, 1e-9, 1);
        const light::SunDepth exact(store, toSun, 1, 1e-9);
        double worst = 0;
        for (std::uint64_t k = 0; k < 5000; ++k) {
            const auto a = maths::uniform4(3, 9, k);
            const glm::dvec3 at = glm::dvec3(1, 2, 3) +
                                  4.0 * glm::dvec3(maths::centred(a[0]), maths::centred(a[1]), maths::centred(a[2]));
            worst = std::max(worst, std::abs(lattice.at(at) - exact.at(at)));
        }
        EXPECT_LT(worst, 1e-3 * std::log(2.0));
        EXPECT_GT(worst, 1e-6);
    }
}

TEST(SunLattice, KeepsToTheClosedFormWhereALatticeWouldBeTooLarge) {
    MemoryLedger ledger;
    const ParticleStore store = test::trail(ledger, 500, 60);
    const SunLattice none(store, lowSun, 1, 1e-9, 1, 10);
    const light::SunDepth exact(store, lowSun, 1, 1e-9);
    EXPECT_EQ(none.nodes(), 0u);
    for (std::uint64_t k = 0; k < 500; ++k) ASSERT_EQ(none.at(pointBy(k)), exact.at(pointBy(k)));
}

TEST(SunLattice, IsTheSameAtAnyNumberOfThreads) {
    const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
    MemoryLedger ledger;
    const ParticleStore store = test::trail(ledger, 500, 30);
    const auto make = [&] { return SunLattice(store, lowSun, 1, 1e-9, 1); };
    const SunLattice one = tbb::task_arena(1).execute(make);
    for (const int threads : {2, 8}) {
        const SunLattice many = tbb::task_arena(threads).execute(make);
        for (std::uint64_t k = 0; k < 500; ++k) ASSERT_EQ(many.at(pointBy(k)), one.at(pointBy(k))) << threads;
    }
}

TEST(SunLattice, IsZeroWithoutPuffs) {
    MemoryLedger ledger;
    EXPECT_EQ(SunLattice(ParticleStore(ledger), {0, 1, 0}, 1, 1e-9, 1).at({1, 2, 3}), 0);
}

}  // namespace
}  // namespace dustbench::reference
