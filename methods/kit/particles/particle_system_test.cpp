#include "methods/kit/particles/particle_system.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <set>

#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/particles/noted_particles.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

using test::advance;
using test::everyForce;
using test::systemFrom;
using test::with;

TEST(ParticleSystem, IsTheSameBitForBitAtAnyNumberOfThreads) {
    const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
    const auto scene = test::sceneWithCar();
    // Random sizes and a source that is switched off and on again, so that holes are filled in every possible way.
    for (const std::int64_t count : {1, 37, 511, 2048, 9973, 30011}) {
        std::set<std::uint64_t> hashes;
        for (const int threads : {1, 2, 3, 8}) {
            auto system = systemFrom(everyForce);
            tbb::task_arena(threads).execute([&] {
                advance(system, scene, 60, 20, count);
                advance(system, scene, 20, 0, 1, 1.0 / 60, 60);
                advance(system, scene, 40, 35, count, 1.0 / 60, 80);
            });
            hashes.insert(system.stateHash());
        }
        EXPECT_EQ(hashes.size(), 1u) << count;
    }
}

TEST(ParticleSystem, HashTellsSeedsAndStepsApart) {
    const auto scene = test::sceneWithCar();
    std::set<std::uint64_t> hashes;
    for (const std::uint64_t seed : {1, 2, 3}) {
        auto system = systemFrom(everyForce, seed);
        for (int step = 0; step < 3; ++step) {
            advance(system, scene, 10, 20, 0, 1.0 / 60, step * 10);
            hashes.insert(system.stateHash());
        }
    }
    EXPECT_EQ(hashes.size(), 9u);
}

// The state depends only on IEEE additions, multiplications, divisions and square roots without contraction, so it is
// the same on every machine and in every build. A different hash means that a part's behaviour has changed.
TEST(ParticleSystem, StateIsTheSameOnEveryMachine) {
    auto system = systemFrom(everyForce);
    advance(system, test::sceneWithCar(), 150);
    EXPECT_EQ(system.stateHash(), 0x672a1238e7cbebf8ULL);
}

TEST(ParticleSystem, SerialsAreUniqueAndNobodyOutlivesHisLifetime) {
    auto system = systemFrom(everyForce);
    const auto scene = test::sceneWithCar();
    for (int i = 0; i < 150; ++i) {
        advance(system, scene, 1, 20, i % 50 < 25 ? 3000 : 10, 1.0 / 60, i);
        const ParticleStore& store = system.store();
        EXPECT_EQ(std::set<std::uint64_t>(store.serial.begin(), store.serial.end()).size(), store.size());
        for (std::size_t k = 0; k < store.size(); ++k) {
            EXPECT_LE(store.age[k], store.lifetime[k] + 1.0f / 60);
            EXPECT_GT(store.lifetime[k], 0.29f);
            EXPECT_GE(store.opacity[k], 0.0f);
            EXPECT_LE(store.opacity[k], 0.999f);
        }
    }
}

TEST(ParticleSystem, MeanCountConvergesToTheFixedCount) {
    const auto scene = test::sceneWithCar();
    for (const std::int64_t count : {100, 5000}) {
        auto system = systemFrom(everyForce);
        EXPECT_DOUBLE_EQ(system.meanLifetimeSeconds(), 0.8);
        advance(system, scene, 120, 7, count);
        double sum = 0;
        constexpr int steps = 600;
        for (int i = 0; i < steps; ++i) {
            advance(system, scene, 1, 7, count, 1.0 / 60, 120 + i);
            sum += static_cast<double>(system.store().size());
        }
        // Lifetimes vary by 0.5/√3 of 0.8 s. In 600 steps 12.5 N particles are born, so the mean is within 36 %/√(12.5
        // N).
        const double error = 0.36 / std::sqrt(12.5 * static_cast<double>(count));
        EXPECT_NEAR(sum / steps / static_cast<double>(count), 1, 4 * error + 0.001);
    }
}

TEST(ParticleSystem, GivesBirthToManyParticlesInThePlaceOfEachAndToTheSameCloud) {
    struct Cloud {
        double count = 0, mass = 0;
        glm::dvec3 mean{0}, deviation{0};
    };
    const auto scene = test::sceneWithCar();
    const auto cloud = [&](std::int64_t fixedCount, std::int64_t particlesPerPuff) {
        auto system = systemFrom(everyForce);
        for (int i = 1; i <= 90; ++i) {
            const auto state = test::drivingStraight(i / 60.0, 20);
            system.update({scene, state, 1.0 / 60, fixedCount, particlesPerPuff});
        }
        const ParticleStore& store = system.store();
        Cloud result{static_cast<double>(store.size())};
        glm::dvec3 squares(0);
        for (std::size_t i = 0; i < store.size(); ++i) {
            const glm::dvec3 at = store.position(i);
            result.mass += maths::puffMassSquareMetres(static_cast<double>(store.opacity[i]),
                                                       static_cast<double>(store.radius[i]));
            result.mean += at / result.count;
            squares += at * at / result.count;
        }
        result.deviation = glm::sqrt(squares - result.mean * result.mean);
        return result;
    };
    for (const std::int64_t fixedCount : {0, 700}) {
        const Cloud one = cloud(fixedCount, 1), many = cloud(fixedCount, 64);
        // Births are evenly spaced; the scatter comes from lifetimes, 36 % of the mean, and quantities that depend on
        // them.
        const double share = 0.36 / std::sqrt(one.count);
        EXPECT_NEAR(many.count / one.count / 64, 1, 4 * share) << fixedCount;
        EXPECT_NEAR(many.mass / one.mass / 64, 1, 8 * share) << fixedCount;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(many.mean[axis], one.mean[axis], 4 * one.deviation[axis] / std::sqrt(one.count));
            EXPECT_NEAR(many.deviation[axis] / one.deviation[axis], 1, 4 / std::sqrt(one.count));
        }
    }
    auto system = systemFrom(everyForce);
    EXPECT_THROW(system.update({scene, test::drivingStraight(1, 20), 1.0 / 60, 0, 0}), std::invalid_argument);
}

TEST(ParticleSystem, AMovedCarLeavesTheSameCloudElsewhere) {
    // Without gusts the physics of everyForce is translation-invariant: the cloud of a standing car is the same
    // anywhere.
    const std::string toml = with(everyForce, "gust_speed = 0.7", "gust_speed = 0");
    const auto scene = test::sceneWithCar();
    auto here = systemFrom(toml), there = systemFrom(toml);
    for (int i = 1; i <= 60; ++i) {
        scene::SceneState state = test::drivingStraight(i / 60.0, 0);
        here.update({scene, state, 1.0 / 60, 500});
        for (auto& wheel : state.vehicle.wheels) wheel.contact += glm::dvec3(16, 0, -32);
        there.update({scene, state, 1.0 / 60, 500});
    }
    ASSERT_EQ(here.store().size(), there.store().size());
    for (std::size_t i = 0; i < here.store().size(); ++i)
        EXPECT_LT(glm::length(here.store().position(i) + glm::vec3(16, 0, -32) - there.store().position(i)), 2e-4f);
}

TEST(ParticleSystem, HoldsAtMost96BytesAParticleAndNoMoreAsTimeGoesOn) {
    const auto scene = test::sceneWithCar();
    for (const bool colours : {false, true}) {
        auto system = systemFrom(everyForce);
        if (colours) system.parts().set(makePart(PartKind::colour, "linear"));
        const auto bytes = [&] {
            std::size_t sum = 0;
            for (const MemoryUse& use : system.memory()) sum += use.cpuBytes;
            return static_cast<double>(sum);
        };
        std::size_t minimum = ~std::size_t{0};
        double maximum = 0;
        for (int i = 0; i < 250; ++i) {
            advance(system, scene, 1, 20, 20000, 1.0 / 60, i);
            if (i > 30) {
                EXPECT_LE(bytes(), 96 * static_cast<double>(system.store().size()));
            }
            if (i == 149) maximum = bytes();
            if (i >= 149) minimum = std::min(minimum, system.store().size());
        }
        EXPECT_GT(minimum, 19000u);
        EXPECT_EQ(bytes(), maximum);  // the memory of the steady state is kept
    }
}

TEST(ParticleSystem, PartsAreSwappedWhileItRuns) {
    const auto scene = test::sceneWithCar();
    auto system = systemFrom(everyForce);
    advance(system, scene, 30);
    EXPECT_TRUE(system.store().uniformColour);
    EXPECT_EQ(system.store().colour(0), glm::vec3(0.6f, 0.5f, 0.4f));
    system.parts().set(makePart(PartKind::colour, "linear", {{"end.red", "0"}}));
    system.parts().set(makePart(PartKind::size, "linear", {{"end_metres", "9"}}));
    advance(system, scene, 1, 20, 0, 1.0 / 60, 30);
    const ParticleStore& store = system.store();
    EXPECT_FALSE(store.uniformColour);
    for (std::size_t i = 0; i < store.size(); ++i) {
        const float share = std::min(store.age[i] / store.lifetime[i], 1.0f);
        EXPECT_FLOAT_EQ(store.red[i], 1 - share);
        EXPECT_FLOAT_EQ(store.radius[i], 0.25f + 8.75f * share);
    }
    system.parts().set(makePart(PartKind::colour, "constant"));
    advance(system, scene, 1, 20, 0, 1.0 / 60, 31);
    EXPECT_TRUE(system.store().uniformColour);
    EXPECT_TRUE(system.store().red.empty());
    system.parts().set(makePart(PartKind::emission, "stream", {{"rate_per_metre", "0"}}));
    advance(system, scene, 90, 20, 0, 1.0 / 60, 32);
    EXPECT_TRUE(system.store().empty());
}

/// Adds constant light; a part of a kind that wheel dust does not use.
class Ambient : public ShadingPart {
 public:
    Ambient() : ShadingPart(ParameterValues()) {}
    void shade(Chunk& chunk, const Step&) const override {
        for (std::size_t i = 0; i < chunk.count; ++i) {
            chunk.luminosityRed[i] += 0.5f;
            chunk.luminosityGreen[i] += 2;
        }
    }
};

TEST(ParticleSystem, ShadingMultipliesTheColourOnceHoweverLongItRuns) {
    const auto scene = test::sceneWithCar();
    for (const char* colour : {"constant", "linear", "bezier"}) {
        auto system = systemFrom(everyForce);
        system.parts().set(makePart(PartKind::colour, colour));
        system.parts().set(std::make_unique<Ambient>());
        advance(system, scene, 40);
        ASSERT_FALSE(system.store().empty());
        for (std::size_t i = 0; i < system.store().size(); ++i)
            EXPECT_LT(glm::length(system.store().colour(i) - glm::vec3(0.5f, 2, 0)), 1e-5f);
    }
}

TEST(ParticleSystem, RefusesAnIncompleteListAndAStepOfNoLength) {
    EXPECT_THROW(ParticleSystem(std::make_unique<PartList>(), 1), InputError);
    auto system = systemFrom(everyForce);
    const auto scene = test::sceneWithCar();
    EXPECT_THROW(advance(system, scene, 1, 20, 0, 0.0), std::invalid_argument);
}

TEST(NotedParticles, CollectsInOrderWhateverTheOrderOfNoting) {
    MemoryLedger ledger;
    NotedParticles deaths(ledger);
    for (const std::size_t total : {0ul, 1ul, 513ul, 5000ul}) {
        std::vector<std::uint8_t> dead(total);
        std::vector<std::uint32_t> expected;
        for (std::size_t i = 0; i < total; ++i) {
            dead[i] = maths::uniform4(1, 1, i)[0] < 0.1f;
            if (dead[i]) expected.push_back(static_cast<std::uint32_t>(i));
        }
        deaths.prepare(total);
        const std::size_t chunks = (total + chunkSize - 1) / chunkSize;
        for (std::size_t chunk = chunks; chunk-- > 0;)
            deaths.note(chunk, dead.data() + chunk * chunkSize, std::min(chunkSize, total - chunk * chunkSize));
        const auto collected = deaths.collect();
        EXPECT_EQ(std::vector<std::uint32_t>(collected.begin(), collected.end()), expected);
    }
}

}  // namespace
}  // namespace dustbench::particles
