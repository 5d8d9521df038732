// Tests springs between particles: closed forms of the oscillator for both steps, the limit of stability, conserved
// momentum, and links that follow the particles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "methods/kit/particles/lattice.h"
#include "methods/kit/particles/test_world.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::particles {
namespace {

/// A lattice that is born at rest in the first step and never dies. `lattice` and `force`: parameters; `more`: forces.
std::string linked(int count, const std::string& lattice, const std::string& force, const std::string& more = "",
                   const std::string& velocity = "part = \"fixed\", speed = 0, variation = 0") {
    return "emission = { part = \"bursts\", count = " + std::to_string(count) +
           ", duration_seconds = 0, interval_seconds = 1e6 }\nposition = { part = \"lattice\", " + lattice +
           " }\nvelocity = { " + velocity +
           " }\ncolour = { part = \"constant\" }\nsize = { part = \"constant\" }\n"
           "life = [ { part = \"lifetime\", average_seconds = 1e6, variation_seconds = 0 } ]\n"
           "force = [ { part = \"springs\", " +
           force + " }, " + more + " ]\n";
}

void stepWorld(ParticleSystem& system, int steps, double seconds) {
    const scene::Scene scene;
    for (int i = 0; i < steps; ++i) {
        const scene::SceneState state;
        system.update({scene, state, seconds});
    }
}

/// A mass on a spring along x, 1 m long at rest: k = ω² for a mass of 1 kg. Born with 0.25 m/s, so that u = v·Δt.
constexpr double startSpeed = 0.25;

ParticleSystem oscillator(double omega, const std::string& more) {
    return test::systemFrom(linked(2, "columns = 2, rows = 1, place = [0, 0, 0], column_step = [1, 0, 0]",
                                   "pins = \"end\", stiffness = " + std::to_string(omega * omega) + ", " + more, "",
                                   "part = \"fixed\", direction = [1, 0, 0], speed = 0.25, variation = 0"));
}

/// Displacement of the mass after each of `steps` steps.
std::vector<double> displacements(ParticleSystem system, int steps, double seconds) {
    std::vector<double> u;
    for (int n = 0; n < steps; ++n) {
        stepWorld(system, 1, seconds);
        u.push_back(static_cast<double>(system.store().x[1]) - 1);
    }
    return u;
}

TEST(Springs, ExplicitOscillatorIsTheClosedFormOfItsStep) {
    // u_n = u_1·sin(nθ)/sin θ with sin(θ/2) = ω·Δt/2
    const double omega = 6, dt = 1.0 / 60, theta = 2 * std::asin(omega * dt / 2);
    const auto u = displacements(oscillator(omega, "step = \"explicit\""), 600, dt);
    for (std::size_t n = 1; n <= u.size(); ++n)
        ASSERT_NEAR(u[n - 1], startSpeed * dt * std::sin(static_cast<double>(n) * theta) / std::sin(theta), 5e-5) << n;
}

TEST(Springs, PeriodConvergesToThatOfTheHarmonicOscillatorAtSecondOrder) {
    const double omega = 6, exact = 2 * M_PI / omega;
    const auto error = [&](double dt) {
        const auto u = displacements(oscillator(omega, "step = \"explicit\""), static_cast<int>(12 / dt), dt);
        std::vector<double> rising;  // times of zero crossings
        for (std::size_t n = 1; n < u.size(); ++n)
            if (u[n - 1] < 0 && u[n] >= 0) rising.push_back((static_cast<double>(n) - u[n] / (u[n] - u[n - 1])) * dt);
        return std::abs((rising.back() - rising.front()) / static_cast<double>(rising.size() - 1) - exact);
    };
    const double coarse = error(1.0 / 30), fine = error(1.0 / 60);
    EXPECT_LT(fine, 1e-3 * exact);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
}

TEST(Springs, ExplicitOscillatorKeepsItsEnergyWithinTheStepsOrder) {
    // The step conserves v² + ω²u² − ω²·Δt·u·v exactly, so that the energy deviates by at most ω·Δt/2 of itself.
    const double omega = 6, dt = 1.0 / 60;
    auto system = oscillator(omega, "step = \"explicit\"");
    double deviation = 0, drift = 0;
    for (int n = 0; n < 3000; ++n) {
        stepWorld(system, 1, dt);
        const double u = static_cast<double>(system.store().x[1]) - 1,
                     v = static_cast<double>(system.store().velocityX[1]), start = startSpeed * startSpeed;
        deviation = std::max(deviation, std::abs((v * v + omega * omega * u * u) / start - 1));
        drift = std::max(drift, std::abs((v * v + omega * omega * u * (u - dt * v)) / start - 1));
    }
    EXPECT_LT(deviation, omega * dt / 2 * 1.1);
    EXPECT_GT(deviation, omega * dt / 2 * 0.8);
    EXPECT_LT(drift, 2e-3);
}

TEST(Springs, DampedExplicitOscillatorIsTheRecurrenceOfItsStep) {
    // u_{n+1} = (2 − c·Δt − ω²Δt²)·u_n − (1 − c·Δt)·u_{n−1}
    const double omega = 6, c = 1.5, dt = 1.0 / 60;
    const auto u = displacements(oscillator(omega, "damping = 1.5, step = \"explicit\""), 300, dt);
    double before = 0, now = startSpeed * dt;
    for (const double each : u) {
        ASSERT_NEAR(each, now, 2e-5);
        const double next = (2 - c * dt - omega * omega * dt * dt) * now - (1 - c * dt) * before;
        before = now;
        now = next;
    }
}

TEST(Springs, PositionStepOfOneSpringIsTheImplicitEulerStep) {
    // v ← (v − ω²h·u)/(1 + c·h + ω²h²), u ← u + h·v: E falls by 1/(1 + ω²h²) in each substep without damping.
    const double omega = 20, dt = 1.0 / 60;
    for (const double c : {0.0, 3.0}) {
        const auto u = displacements(
            oscillator(omega, "step = \"position\", substeps = 4, damping = " + std::to_string(c)), 120, dt);
        double now = startSpeed * dt, v = startSpeed;
        const double h = dt / 4;
        double energy = v * v + omega * omega * now * now;
        for (const double each : u) {
            ASSERT_NEAR(each, now, 1e-6);
            for (int substep = 0; substep < 4; ++substep) {
                v = (v - omega * omega * h * now) / (1 + c * h + omega * omega * h * h);
                now += h * v;
                const double next = v * v + omega * omega * now * now;
                if (c == 0) {
                    ASSERT_NEAR(next / energy, 1 / (1 + omega * omega * h * h), 1e-9);
                }
                energy = next;
            }
        }
    }
}

/// Maximum displacement over 3000 steps of a chain of 12 masses that hangs on nothing and is pulled once.
double largestOfChain(double seconds, double damping, const std::string& more) {
    auto system = test::systemFrom(
        linked(12, "columns = 12, rows = 1, place = [0, 0, 0], column_step = [0.1, 0, 0]",
               "pins = \"end\", stiffness = 100, diagonals = 0, bending = 0, step = \"explicit\", damping = " +
                   std::to_string(damping) + more,
               "", "part = \"fixed\", direction = [1, 0, 0], speed = 0.02, variation = 0"));
    double largest = 0;
    for (int n = 0; n < 3000 && largest < 1e3; ++n) {
        stepWorld(system, 1, seconds);
        for (std::size_t i = 0; i < system.store().size(); ++i)
            largest =
                std::max(largest, std::abs(static_cast<double>(system.store().x[i]) - 0.1 * static_cast<double>(i)));
    }
    return largest;
}

TEST(Springs, ExplicitStepIsBoundedBelowItsLimitAndDivergesAbove) {
    // λ = 4 for an inner mass of a chain: Δt < 2/ω = √(m/k) = 0.1 s. The largest eigenvalue of 11 masses is 3.93.
    EXPECT_LT(largestOfChain(0.099, 0, ""), 0.1);
    EXPECT_GT(largestOfChain(0.103, 0, ", beyond_limit = \"run\""), 1e3);
    // With c: k·Δt² + 2·c·Δt = 4·m/λ.
    const double limit = (std::sqrt(4 + 100.0) - 2) / 100;
    EXPECT_LT(largestOfChain(0.99 * limit, 2, ""), 0.1);
    // Here the chain folds before it grows further.
    EXPECT_GT(largestOfChain(1.03 * limit, 2, ", beyond_limit = \"run\""), 1);
}

TEST(Springs, ExplicitStepBeyondItsLimitIsAnErrorThatNamesTheLimit) {
    const std::string error = inputError([] { (void)largestOfChain(0.101, 0, ""); });
    EXPECT_THAT(error, testing::HasSubstr("got a step of 0.101 s"));
    EXPECT_THAT(error, testing::HasSubstr("less than 0.1 s"));
    EXPECT_THAT(inputError([] { (void)largestOfChain(0.09, 2, ""); }), testing::HasSubstr("less than 0.0819"));
}

TEST(Springs, NeedALattice) {
    const std::string toml = test::with(linked(2, "columns = 2, rows = 1", "bending = 0"),
                                        "part = \"lattice\", columns = 2, rows = 1", "part = \"disc\"");
    EXPECT_THAT(inputError([&] { (void)test::systemFrom(toml); }), testing::HasSubstr("allowed: 'lattice'"));
}

glm::dvec3 momentumOf(const ParticleStore& s) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < s.size(); ++i) sum += glm::dvec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
    return sum;
}

constexpr const char* block =
    "columns = 9, rows = 7, layers = 4, column_step = [0.1, 0, 0], row_step = [0, -0.1, 0], "
    "layer_step = [0, 0, 0.1]";
constexpr const char* inAllDirections = "part = \"random\", speed = 0.3, variation = 0.5";

TEST(Springs, InternalForcesKeepMomentumToRounding) {
    for (const std::string step : {"explicit", "position"}) {
        auto system = test::systemFrom(linked(
            252, block, "stiffness = 150, damping = 0.5, substeps = 3, step = \"" + step + "\"", "", inAllDirections));
        stepWorld(system, 1, 1.0 / 60);
        const glm::dvec3 before = momentumOf(system.store());
        stepWorld(system, 200, 1.0 / 60);
        // Positions of 2 m are rounded by 1e-7, which 1/Δt turns into 1e-5 m/s; 252 random ones for 200 steps.
        EXPECT_LT(glm::length(momentumOf(system.store()) - before), 4e-3) << step;
    }
}

TEST(Springs, DampingTakesEnergyAndNeverGivesIt) {
    auto system =
        test::systemFrom(linked(252, block, "stiffness = 60, damping = 0.4, step = \"explicit\"", "", inAllDirections));
    stepWorld(system, 1, 1.0 / 60);
    const auto kinetic = [&] {
        const ParticleStore& s = system.store();
        const glm::dvec3 mean = momentumOf(s) / static_cast<double>(s.size());
        double sum = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const glm::dvec3 v = glm::dvec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]) - mean;
            sum += glm::dot(v, v);
        }
        return sum;
    };
    const double before = kinetic();
    stepWorld(system, 240, 1.0 / 60);
    EXPECT_LT(kinetic(), 0.2 * before);
}

TEST(Springs, AreTheSameBitForBitAtAnyNumberOfThreads) {
    const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
    for (const std::string step : {"explicit", "position"}) {
        std::set<std::uint64_t> hashes;
        for (const int threads : {1, 2, 3, 8}) {
            auto system =
                test::systemFrom(linked(4096, "columns = 64, rows = 64",
                                        "stiffness = 400, pins = \"row\", substeps = 3, step = \"" + step + "\"",
                                        "{ part = \"gravity\" }, { part = \"sail\" }, { part = \"bounce\", shape = "
                                        "\"sphere\", radius_metres = 1.2 }"));
            tbb::task_arena(threads).execute([&] { stepWorld(system, 20, 1.0 / 60); });
            hashes.insert(system.stateHash());
        }
        EXPECT_EQ(hashes.size(), 1u) << step;
    }
}

using SerialPair = std::pair<std::uint64_t, std::uint64_t>;
std::set<SerialPair> pairsOf(const LatticeLinks& links, const std::vector<std::uint64_t>& serials) {
    std::set<SerialPair> pairs;
    for (const Link& link : links.links()) pairs.emplace(serials[link.a], serials[link.b]);
    return pairs;
}

TEST(LatticeLinks, DoNotDependOnTheOrderOfStorage) {
    ParameterSet set;
    Lattice::declare(set);
    ParameterValues values(set);
    for (const auto& [name, value] : {std::pair{"columns", "5"}, {"rows", "4"}, {"layers", "3"}})
        values.set(name, value);
    const Lattice lattice = Lattice::from(values);
    std::vector<std::uint64_t> serials(150);  // two pieces and a half; some particles are missing
    for (std::size_t i = 0; i < serials.size(); ++i) serials[i] = 3 + i + (i > 70 ? 5 : 0);
    LatticeLinks sorted, mixed;
    sorted.follow(lattice, Pins::row, {}, serials);
    const auto pairs = pairsOf(sorted, serials);
    std::vector<std::uint64_t> other(serials);
    for (std::size_t i = 0; i < other.size(); ++i) std::swap(other[i], other[i * 37 % other.size()]);
    mixed.follow(lattice, Pins::row, {}, other);
    EXPECT_EQ(pairsOf(mixed, other), pairs);
    EXPECT_EQ(mixed.pinned().size(), sorted.pinned().size());
    // Every pair is one link, and its nodes are as far apart as an edge, a diagonal or two edges of one piece.
    EXPECT_EQ(pairs.size(), sorted.links().size());
    for (const auto& [a, b] : pairs) {
        EXPECT_EQ(a / lattice.size(), b / lattice.size());
        const glm::ivec3 apart = glm::abs(lattice.nodeOf(b) - lattice.nodeOf(a));
        EXPECT_TRUE(apart.x + apart.y + apart.z == 1 || apart.x + apart.y + apart.z == 2);
    }
}

TEST(LatticeLinks, OfAColourShareNoParticle) {
    ParameterSet set;
    Lattice::declare(set);
    ParameterValues values(set);
    values.set("layers", "5");
    const Lattice lattice = Lattice::from(values);
    std::vector<std::uint64_t> serials(lattice.size());
    for (std::size_t i = 0; i < serials.size(); ++i) serials[i] = i;
    LatticeLinks links;
    links.follow(lattice, Pins::none, {}, serials);
    for (std::size_t c = 0; c < links.colours(); ++c) {
        std::set<std::uint32_t> seen;
        for (const Link& link : links.ofColour(c)) {
            EXPECT_TRUE(seen.insert(link.a).second);
            EXPECT_TRUE(seen.insert(link.b).second);
        }
    }
}

}  // namespace
}  // namespace dustbench::particles
