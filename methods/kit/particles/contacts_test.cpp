// Compares bounces and deaths at surfaces with closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "methods/kit/maths/fast_functions.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/test_world.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::particles {
namespace {

/// Particles born in the first step at points of a ball, in all directions; `more` contains forces and lives.
std::string swarm(const std::string& place, double radius, const std::string& velocity, const std::string& forces,
                  const std::string& lives = "", int count = 500) {
    return "emission = { part = \"bursts\", count = " + std::to_string(count) +
           ", duration_seconds = 0, interval_seconds = 1e6 }\n"
           "position = { part = \"sphere\", at = \"place\", place = " +
           place + ", radius_metres = " + std::to_string(radius) + " }\nvelocity = { " + velocity +
           " }\ncolour = { part = \"constant\" }\nsize = { part = \"constant\", radius_metres = 0 }\n"
           "life = [ { part = \"lifetime\", average_seconds = 1e5, variation_seconds = 0 }, " +
           lives + " ]\nforce = [ " + forces + " ]\n";
}

void stepContacts(ParticleSystem& system, int steps, double seconds = 1.0 / 64) {
    const scene::Scene scene;
    for (int i = 0; i < steps; ++i) {
        const scene::SceneState state;
        system.update({scene, state, seconds});
    }
}

double contactEnergy(const ParticleStore& s, std::size_t i) {
    const glm::dvec3 v(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
    return glm::dot(v, v) / 2;
}

TEST(Bounce, GoesThereAndBackExactlyBetweenTwoPlanes) {
    // Planes at y = 0 and y = 2, start at y = 1 with 3 m/s upwards: y is a triangle wave.
    auto system =
        test::systemFrom(swarm("[0, 1, 0]", 0, "part = \"fixed\", direction = [0, 1, 0], speed = 3",
                               "{ part = \"bounce\", restitution = 1 }, "
                               "{ part = \"bounce\", restitution = 1, place = [0, 2, 0], normal = [0, -1, 0] }",
                               "", 1));
    for (int i = 0; i < 2000; ++i) {
        stepContacts(system, 1);
        const double way = 1 + 3 * static_cast<double>(system.store().age[0]);
        const double folded = std::fmod(way, 4);
        // Each of 140 bounces keeps a distance of 1e-6 m from the surface.
        ASSERT_NEAR(system.store().y[0], folded < 2 ? folded : 4 - folded, 1e-3);
        ASSERT_NEAR(std::abs(system.store().velocityY[0]), 3, 1e-6);
    }
}

TEST(Bounce, KeepsEnergyAtRestitution1WhateverTheSurface) {
    for (const std::string shape : {"shape = \"sphere\", radius_metres = 1.5", "shape = \"half_space\"",
                                    "shape = \"disc\", radius_metres = 3, normal = [0.3, 1, 0]",
                                    "shape = \"mesh\", mesh = \"hare\", scale = 2"}) {
        auto system = test::systemFrom(swarm("[0, 4, 0]", 1, "part = \"random\", speed = 20",
                                             "{ part = \"bounce\", restitution = 1, " + shape + " }"));
        stepContacts(system, 60);
        std::size_t turned = 0;
        for (std::size_t i = 0; i < system.store().size(); ++i) {
            ASSERT_NEAR(contactEnergy(system.store(), i), 200, 200 * 1e-5) << shape;
            const glm::vec3 flown = system.store().position(i) - glm::vec3(0, 4, 0);
            turned += glm::length(flown) < 18.5f ? 1 : 0;
        }
        EXPECT_GT(turned, 5u) << shape;  // a path of 18.75 m that is not straight
    }
}

TEST(Bounce, LosesTheSharesOfItsVelocityThatItSays) {
    auto system = test::systemFrom(swarm("[0, 1, 0]", 0, "part = \"fixed\", direction = [0.6, -0.8, 0], speed = 5",
                                         "{ part = \"bounce\", restitution = 0.25, friction = 0.5 }", "", 1));
    stepContacts(system, 64);
    EXPECT_NEAR(system.store().velocityX[0], 1.5, 1e-5);
    EXPECT_NEAR(system.store().velocityY[0], 1, 1e-5);
    // Falls for 1/4 s, then rises.
    const double since = static_cast<double>(system.store().age[0]) - 0.25;
    EXPECT_NEAR(system.store().x[0], 3 * 0.25 + 1.5 * since, 1e-4);
    EXPECT_NEAR(system.store().y[0], since, 1e-4);
}

TEST(Bounce, IsSymmetricalAboutTheSurfacesNormal) {
    // On a sphere: the mirror's normal is that of the point of contact.
    auto system = test::systemFrom(swarm("[-5, 0.5, 0]", 0, "part = \"fixed\", direction = [1, 0, 0], speed = 40",
                                         "{ part = \"bounce\", restitution = 1, shape = \"sphere\" }", "", 1));
    stepContacts(system, 10);
    const glm::dvec3 normal(-std::sqrt(0.75), 0.5, 0);
    const glm::dvec3 expected = glm::reflect(glm::dvec3(40, 0, 0), normal);
    EXPECT_NEAR(system.store().velocityX[0], expected.x, 1e-3);
    EXPECT_NEAR(system.store().velocityY[0], expected.y, 1e-3);
    const double after = static_cast<double>(system.store().age[0]) - (5 - std::sqrt(0.75)) / 40;
    EXPECT_NEAR(system.store().x[0], normal.x + after * expected.x, 1e-3);
    EXPECT_NEAR(system.store().y[0], normal.y + after * expected.y, 1e-3);
}

/// Returns the share of particles that end on the other side of a surface towards which they fly.
double shareThrough(const std::string& mode, double speed, bool gravity) {
    auto system = test::systemFrom(swarm(
        "[0, 2, 0]", 0.5,
        "part = \"cone\", direction = [0, -1, 0], half_angle_degrees = 10, variation = 0.5, "
        "speed = " +
            std::to_string(speed),
        "{ part = \"bounce\", mode = \"" + mode + "\", shape = \"disc\", radius_metres = 1000, restitution = 0.5 }" +
            (gravity ? ", { part = \"gravity\" }" : "")));
    stepContacts(system, 400);
    std::size_t through = 0;
    for (const float y : system.store().y) through += y < 0 ? 1 : 0;
    return static_cast<double>(through) / static_cast<double>(system.store().size());
}

TEST(Bounce, NothingPassesADiscAtAnySpeedWhereFixed) {
    for (const double speed : {0.0, 0.5, 30.0, 1000.0})
        for (const bool gravity : {false, true}) EXPECT_EQ(shareThrough("fixed", speed, gravity), 0) << speed;
    // As printed, the rest of the path after a contact is lost to rounding and to the margin: some particles pass.
    EXPECT_GT(shareThrough("paper", 30, true), 0.01);
}

TEST(Bounce, NothingEntersAMeshOrASphereAtAnySpeed) {
    const std::string box =
        "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    const TestFolder folder;
    const std::string file = folder.write("box.obj", box).string();
    for (const double speed : {5.0, 500.0}) {
        // The box and the ball are closed: particles neither leave nor enter.
        auto held = test::systemFrom(
            swarm("[0, 0, 0]", 0.5, "part = \"random\", speed = " + std::to_string(speed),
                  "{ part = \"bounce\", shape = \"mesh\", mesh = \"" + file + "\", restitution = 1 }", "", 200));
        stepContacts(held, 200);
        for (std::size_t i = 0; i < held.store().size(); ++i)
            ASSERT_LE(glm::length(glm::max(glm::abs(held.store().position(i)) - 1.0f, 0.0f)), 0.0f) << speed;
        auto away = test::systemFrom(swarm("[3, 0, 0]", 0.5, "part = \"random\", speed = " + std::to_string(speed),
                                           "{ part = \"bounce\", shape = \"sphere\", restitution = 1 }, "
                                           "{ part = \"attractor\", strength = 50 }"));
        stepContacts(away, 200);
        for (std::size_t i = 0; i < away.store().size(); ++i)
            ASSERT_GE(glm::length(away.store().position(i)), 1 - 1e-6f) << speed;
    }
}

TEST(Bounce, ComesToRestOnAPlaneAndDoesNotSink) {
    auto system = test::systemFrom(swarm("[0, 0.2, 0]", 0, "part = \"fixed\", direction = [1, 0, 0], speed = 1",
                                         "{ part = \"gravity\" }, { part = \"bounce\", restitution = 0.3, friction = "
                                         "0.2 }",
                                         "", 1));
    stepContacts(system, 2000);
    EXPECT_GE(system.store().y[0], 0);
    EXPECT_LT(system.store().y[0], 1e-3);
    EXPECT_NEAR(system.store().velocityX[0], 0, 1e-4);
}

TEST(Bounce, PaperModeMirrorsAtTheCurrentPlaceAndScalesTheWholeVelocity) {
    auto system = test::systemFrom(swarm("[0, 1, 0]", 0, "part = \"fixed\", direction = [0.6, -0.8, 0], speed = 5",
                                         "{ part = \"bounce\", mode = \"paper\", restitution = 0.5 }", "", 1));
    stepContacts(system, 64);
    EXPECT_NEAR(system.store().velocityX[0], 1.5, 1e-5);
    EXPECT_NEAR(system.store().velocityY[0], 2, 1e-5);
}

TEST(Collision, KillsWhatMeetsTheSurfaceAndNothingElse) {
    for (const std::string mode : {"fixed", "paper"}) {
        auto system = test::systemFrom(swarm("[0, 4, 0]", 1, "part = \"random\", speed = 20", "",
                                             "{ part = \"collision\", mode = \"" + mode + "\" }"));
        const auto all = [&] {
            stepContacts(system, 1);
            return system.store().size();
        }();
        auto free = test::systemFrom(swarm("[0, 4, 0]", 1, "part = \"random\", speed = 20", ""));
        stepContacts(free, 1);
        stepContacts(system, 62);
        stepContacts(free, 62);
        std::set<std::uint64_t> above, left(system.store().serial.begin(), system.store().serial.end());
        for (std::size_t i = 0; i < free.store().size(); ++i)
            if (free.store().y[i] > (mode == "paper" ? 0.4f : 0.0f)) above.insert(free.store().serial[i]);
        EXPECT_EQ(all, 500u);
        EXPECT_LT(left.size(), 400u);
        if (mode == "fixed") {
            EXPECT_EQ(left, above);
        } else {
            // Dies up to one step before the surface: 20 m/s · 1/64 s.
            for (const std::uint64_t serial : above) EXPECT_TRUE(left.contains(serial));
        }
    }
}

TEST(Attractor, FollowsItsLawAndIsDefinedAtItsVeryPlace) {
    struct Case {
        const char* law;
        double (*f)(double);
    };
    const Case cases[] = {{"d", [](double d) { return d; }},
                          {"1/d", [](double d) { return 1 / d; }},
                          {"1/d2", [](double d) { return 1 / (d * d); }},
                          {"1/d3", [](double d) { return 1 / (d * d * d); }},
                          {"1/sqrt_d", [](double d) { return 1 / std::sqrt(d); }},
                          {"1/log_1+d", [](double d) { return 1 / std::log(1 + d); }},
                          {"1/log_d", [](double d) { return 1 / std::log(d); }}};
    const scene::Scene scene;
    const scene::SceneState state;
    const Step once{scene, state, 1.0 / 60, 1, 0, {}};
    for (const Case& c : cases) {
        const auto part =
            makePartOf<ForcePart>(PartKind::force, "attractor",
                                  {{"law", c.law}, {"strength", "3"}, {"softening_metres", "0.001"}, {"place.x", "2"}});
        std::vector<float> x{2, 3, 2.5f, 12, 2, 102}, y(6, 0), z(6, 0), ax(6, 0), ay(6, 0), az(6, 0);
        z[4] = -1e-20f;
        Chunk chunk;
        chunk.count = 6;
        chunk.x = x.data(), chunk.y = y.data(), chunk.z = z.data();
        chunk.accelerationX = ax.data(), chunk.accelerationY = ay.data(), chunk.accelerationZ = az.data();
        part->push(chunk, once);
        for (std::size_t i = 0; i < 6; ++i) EXPECT_TRUE(std::isfinite(ax[i]) && std::isfinite(az[i])) << c.law;
        EXPECT_EQ(ax[0], 0);  // at its exact position
        for (const std::size_t i : {std::size_t{2}, std::size_t{3}, std::size_t{5}}) {
            const double d = static_cast<double>(x[i]) - 2;
            EXPECT_NEAR(static_cast<double>(ax[i]) / (-3 * c.f(d)), 1, 2e-5) << c.law << " at " << d;
        }
        // The pole of 1/log d at 1 m is limited to 20.
        EXPECT_LE(std::abs(ax[1]), std::string(c.law) == "1/log_d" ? 3 * 20.001f : 3 * 1.5f) << c.law;
    }
}

TEST(Constant, ForceOverMassIsNewtonsAndTheirProductThePapers) {
    const scene::Scene scene;
    const scene::SceneState state;
    for (const bool paper : {false, true}) {
        const auto part = makePartOf<ForcePart>(
            PartKind::force, "constant",
            {{"force.x", "1"}, {"force.y", "-2"}, {"mass_kilograms", "4"}, {"mode", paper ? "paper" : "fixed"}});
        float ax = 1, ay = 1, az = 1;
        Chunk chunk;
        chunk.count = 1;
        chunk.accelerationX = &ax, chunk.accelerationY = &ay, chunk.accelerationZ = &az;
        part->push(chunk, {scene, state, 1, 1, 0, {}});
        EXPECT_EQ(ax, 1 + (paper ? 4.0f : 0.25f));
        EXPECT_EQ(ay, 1 - (paper ? 8.0f : 0.5f));
        EXPECT_EQ(az, 1);
    }
}

TEST(Logarithm, IsThatOfTheLibraryToItsRounding) {
    for (double v = 1e-6; v < 1e9; v *= 1.0037) {
        const float f = static_cast<float>(v);
        const double expected = std::log(static_cast<double>(f));
        ASSERT_NEAR(maths::naturalLogarithm(f), expected, 3e-7 * std::abs(expected) + 1e-8) << f;
    }
}

}  // namespace
}  // namespace dustbench::particles
