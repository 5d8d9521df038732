// Tests the forces between particles: conservation, the tree compared with all pairs, equal bits at any number of
// threads.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/attraction.h"
#include "methods/kit/particles/interaction_experiment.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

/// A closed system: all particles are born in the first step and none dies.
std::string closed(int count, const std::string& interaction) {
    return "emission = { part = \"bursts\", count = " + std::to_string(count) +
           ", duration_seconds = 0, interval_seconds = 1e6 }\n"
           "position = { part = \"sphere\", at = \"place\", radius_metres = 2 }\n"
           "velocity = { part = \"random\", speed = 0.5, variation = 0.5 }\n"
           "colour = { part = \"constant\" }\nsize = { part = \"constant\" }\n"
           "life = [ { part = \"lifetime\", average_seconds = 1e5, variation_seconds = 0 } ]\n"
           "force = [ { part = \"interaction\", " +
           interaction + " } ]\n";
}

void step(ParticleSystem& system, int steps, double seconds) {
    const scene::Scene scene;
    for (int i = 0; i < steps; ++i) {
        const scene::SceneState state;
        system.update({scene, state, seconds});
    }
}

glm::dvec3 momentum(const ParticleStore& s) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < s.size(); ++i) sum += glm::dvec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
    return sum;
}

/// Kinetic energy and −k/√(d² + ε²) of each pair.
double energy(const ParticleStore& s, double k, double softening) {
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const glm::dvec3 v(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
        sum += glm::dot(v, v) / 2;
        for (std::size_t j = 0; j < i; ++j) {
            const glm::dvec3 d = glm::dvec3(s.position(i)) - glm::dvec3(s.position(j));
            sum -= k / std::sqrt(glm::dot(d, d) + softening * softening);
        }
    }
    return sum;
}

TEST(Interaction, AllPairsKeepMomentumToRounding) {
    for (const std::string law : {"1/d", "1/d2", "1/d3", "1/sqrt_d", "1/log_1+d", "1/log_d"}) {
        auto system =
            test::systemFrom(closed(400, "method = \"pairs\", softening_metres = 0.2, law = \"" + law + "\""));
        step(system, 1, 1.0 / 60);
        const glm::dvec3 before = momentum(system.store());
        step(system, 200, 1.0 / 60);
        // A velocity of 1 m/s is rounded by 6e-8 in each of 200 steps, 400 times: 2e-5 in random directions.
        EXPECT_LT(glm::length(momentum(system.store()) - before), 4e-5) << law;
    }
}

TEST(Interaction, EnergyDriftsAtFirstOrderOfTheStep) {
    const auto drift = [](double seconds) {
        auto system = test::systemFrom(closed(150, "method = \"pairs\", strength = 0.02, softening_metres = 0.5"));
        step(system, 1, 1.0 / 512);
        const double before = energy(system.store(), 0.02, 0.5);
        double worst = 0;
        for (int i = 0; i < 8; ++i) {
            step(system, static_cast<int>(std::lround(0.25 / seconds)), seconds);
            worst = std::max(worst, std::abs(energy(system.store(), 0.02, 0.5) - before));
        }
        return worst / std::abs(before);
    };
    const double coarse = drift(1.0 / 32), fine = drift(1.0 / 64), finest = drift(1.0 / 128);
    EXPECT_LT(finest, 0.01);
    EXPECT_NEAR(std::log2(coarse / fine), 1, 0.2);
    EXPECT_NEAR(std::log2(fine / finest), 1, 0.2);
}

TEST(Interaction, IsTheSameBitForBitAtAnyNumberOfThreads) {
    const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
    for (const std::string method : {"pairs", "tree"}) {
        std::set<std::uint64_t> hashes;
        for (const int threads : {1, 2, 3, 8}) {
            auto system = test::systemFrom(closed(3001, "method = \"" + method + "\""));
            tbb::task_arena(threads).execute([&] { step(system, 6, 1.0 / 60); });
            hashes.insert(system.stateHash());
        }
        EXPECT_EQ(hashes.size(), 1u) << method;
    }
}

struct Cloud {
    std::vector<float> x, y, z;
    explicit Cloud(std::size_t count, std::uint64_t seed) : x(count), y(count), z(count) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto u = maths::uniform4(seed, 1, i);
            // Clumped: half of the bodies are within a tenth of the radius.
            const glm::vec3 p = (i % 2 ? 1.0f : 10.0f) * maths::denseBallPoint(u[0], u[1], u[2]);
            x[i] = p.x, y[i] = p.y, z[i] = p.z;
        }
    }
};
struct Pull {
    std::vector<float> x, y, z;
    explicit Pull(std::size_t count) : x(count), y(count), z(count) {}
};

Pull byPairs(const Cloud& cloud, const Attraction& attraction) {
    const std::size_t n = cloud.x.size();
    Pull pull(n);
    const std::vector<float> masses(n, 1);
    addPull(attraction, {cloud.x, cloud.y, cloud.z, masses},
            {n, cloud.x.data(), cloud.y.data(), cloud.z.data(), pull.x.data(), pull.y.data(), pull.z.data()});
    return pull;
}

Pull byTree(const Cloud& cloud, const Attraction& attraction, float angle, FarBodies far = FarBodies::centreOfMass) {
    Pull pull(cloud.x.size());
    AttractionTree tree;
    tree.build(cloud.x, cloud.y, cloud.z);
    tree.pull(attraction, angle, far, pull.x, pull.y, pull.z);
    return pull;
}

/// Returns the root mean square of the difference relative to that of the attraction.
double relativeError(const Pull& exact, const Pull& other) {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < exact.x.size(); ++i) {
        const glm::dvec3 e(exact.x[i], exact.y[i], exact.z[i]), o(other.x[i], other.y[i], other.z[i]);
        difference += glm::dot(e - o, e - o);
        size += glm::dot(e, e);
    }
    return std::sqrt(difference / size);
}

TEST(Attraction, SumOfPairsIsThatOfAPlainLoopInDoublePrecision) {
    const Cloud cloud(301, 5);
    const Pull pull = byPairs(cloud, {AttractionLaw::inverseSquare, 2, 0.1f});
    Pull plain(301);
    for (std::size_t i = 0; i < 301; ++i) {
        glm::dvec3 sum(0);
        for (std::size_t j = 0; j < 301; ++j) {
            const glm::dvec3 r(static_cast<double>(cloud.x[j]) - static_cast<double>(cloud.x[i]),
                               static_cast<double>(cloud.y[j]) - static_cast<double>(cloud.y[i]),
                               static_cast<double>(cloud.z[j]) - static_cast<double>(cloud.z[i]));
            sum += 2.0 * r / std::pow(glm::dot(r, r) + 0.01, 1.5);
        }
        plain.x[i] = static_cast<float>(sum.x), plain.y[i] = static_cast<float>(sum.y);
        plain.z[i] = static_cast<float>(sum.z);
    }
    EXPECT_LT(relativeError(plain, pull), 1e-6);
}

TEST(AttractionTree, WithoutAnAngleIsTheSumOfPairs) {
    for (const std::size_t count : {2, 9, 33, 700}) {
        const Cloud cloud(count, 3);
        const Attraction attraction{AttractionLaw::inverse, 1, 0.1f};
        EXPECT_LT(relativeError(byPairs(cloud, attraction), byTree(cloud, attraction, 0)), 2e-6);
    }
}

TEST(AttractionTree, ErrorFallsWithTheAngleAndIgnoringIsWorse) {
    const Cloud cloud(4000, 7);
    for (const auto law : {AttractionLaw::inverseSquare, AttractionLaw::inverse, AttractionLaw::inverseCube}) {
        const Attraction attraction{law, 1, 0.05f};
        const Pull exact = byPairs(cloud, attraction);
        double last = 1;
        for (const float angle : {1.5f, 0.8f, 0.4f, 0.2f}) {
            const double error = relativeError(exact, byTree(cloud, attraction, angle));
            EXPECT_LT(error, last);
            last = error;
        }
        EXPECT_LT(relativeError(exact, byTree(cloud, attraction, 0.4f)), 0.01);
        EXPECT_GT(relativeError(exact, byTree(cloud, attraction, 0.8f, FarBodies::ignored)),
                  5 * relativeError(exact, byTree(cloud, attraction, 0.8f)));
    }
}

TEST(AttractionTree, TakesBodiesAtOnePlaceAndNone) {
    AttractionTree tree;
    tree.build({}, {}, {});
    tree.pull({}, 0.5f, FarBodies::centreOfMass, {}, {}, {});
    const std::vector<float> same(100, 3);
    std::vector<float> x(100, 9), y(100, 9), z(100, 9);
    tree.build(same, same, same);
    tree.pull({}, 0.5f, FarBodies::centreOfMass, x, y, z);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(x[i], 0);
}

TEST(AttractionTree, NeedsFewerPairsThanAllFromAThousandBodiesOn) {
    const Cloud cloud(30000, 2);
    AttractionTree tree;
    tree.build(cloud.x, cloud.y, cloud.z);
    EXPECT_LT(tree.pairs(0.6f, FarBodies::centreOfMass), 30000LL * 30000 / 10);
    EXPECT_LT(tree.pairs(0.6f, FarBodies::ignored), tree.pairs(0.6f, FarBodies::centreOfMass));
    EXPECT_EQ(tree.pairs(0, FarBodies::centreOfMass), 30000LL * 30000);
}

}  // namespace
}  // namespace dustbench::particles

namespace dustbench::particles::interaction {
namespace {

TEST(InteractionExperiment, ErrorGrowsWithTheAngleAndWorkLessThanItsSquare) {
    for (const std::uint64_t seed : {1u, 2u}) {
        std::map<std::string, Finding> found;
        for (Finding& finding : measureErrors(seed)) found[finding.quantity] = finding;
        EXPECT_LT(found.at("rms_angle_0.6").high, 0.01);
        EXPECT_LT(found.at("rms_angle_0.3").high, found.at("rms_angle_0.6").low);
        EXPECT_LT(found.at("rms_angle_0.6").high, found.at("rms_angle_1.2").low);
        // A cell's dipole vanishes about its centre of mass; the quadrupole term decreases as the square of the angle,
        // and errors of many cells add up as their root.
        EXPECT_GT(found.at("error_exponent").value, 1.5);
        EXPECT_LT(found.at("error_exponent").value, 3.5);
        EXPECT_GT(found.at("rms_ignored_0.6").low, 0.3);
        // With a force that falls faster, the error comes from nearer bodies: combined and ignored ones matter less.
        EXPECT_LT(found.at("rms_cube_ignored_0.6").high, found.at("rms_ignored_0.6").low);
        EXPECT_LT(found.at("rms_cube_ignored_0.1").high, found.at("rms_cube_ignored_0.6").low);
        for (const char* name : {"rms_cube_ignored_0.1", "rms_cube_ignored_0.3", "rms_cube_ignored_0.6"})
            RecordProperty(std::string(name) + "_seed_" + std::to_string(seed), std::to_string(found.at(name).value));
        EXPECT_LT(found.at("rms_cube_angle_0.6").high, found.at("rms_cube_ignored_0.6").low);
        EXPECT_EQ(found.at("together_over_together_0.6").value, 1);
        EXPECT_EQ(found.at("ignored_over_together_0.6").value,
                  found.at("rms_ignored_0.6").value / found.at("rms_angle_0.6").value);
        EXPECT_GT(found.at("tree_work_exponent").low, 0.9);
        EXPECT_LT(found.at("tree_work_exponent").high, 1.4);
    }
}

}  // namespace
}  // namespace dustbench::particles::interaction
