// Tests cloth: bounds on its stretch, no point inside a ball or under the ground, a flag that follows the vehicle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "methods/kit/particles/lattice.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

/// A sheet of 24 × 20 points, 5 cm apart; 1 kg/m².
std::string sheet(const std::string& lattice, const std::string& springs, const std::string& forces,
                  const std::string& velocity = "part = \"fixed\", speed = 0, variation = 0") {
    return "emission = { part = \"bursts\", count = 480, duration_seconds = 0, interval_seconds = 1e6 }\n"
           "position = { part = \"lattice\", columns = 24, rows = 20, column_step = [0.05, 0, 0], " +
           lattice + " }\nvelocity = { " + velocity +
           " }\ncolour = { part = \"constant\" }\nsize = { part = \"constant\" }\n"
           "life = [ { part = \"lifetime\", average_seconds = 1e6, variation_seconds = 0 } ]\n"
           "force = [ { part = \"gravity\", acceleration = 9.8 },\n"
           "{ part = \"springs\", mass_kg = 0.0025, stiffness = 500, damping = 0.01, bending = 0.02, " +
           springs + " }, " + forces + " ]\n";
}

/// Maximum of |x_a − x_b|/L − 1 over all edges.
double largestStretch(const ParticleStore& s) {
    double largest = -1;
    for (std::size_t i = 0; i < 480; ++i)
        for (const std::size_t ahead : {std::size_t{1}, std::size_t{24}}) {
            if (ahead == 1 ? i % 24 == 23 : i + 24 >= 480) continue;
            largest =
                std::max(largest, static_cast<double>(glm::distance(s.position(i), s.position(i + ahead))) / 0.05 - 1);
        }
    return largest;
}

TEST(Cloth, HangsWithinTheStretchOfItsSpringsAndOfItsStep) {
    // The first row carries N = 19 rows: N·m·g/k by its springs, and 2·N·g·h² by the substeps
    // (parts/force/springs.cpp).
    const double springs = 19 * 0.0025 * 9.8 / 500 / 0.05;
    double before = 1;
    for (const int substeps : {4, 8, 16}) {
        auto system =
            test::systemFrom(sheet("row_step = [0, -0.05, 0]", "pins = \"row\", substeps = " + std::to_string(substeps),
                                   "{ part = \"drag\", rate_per_second = 2 }"));
        test::advance(system, scene::Scene{}, 600);
        const double h = 1.0 / 60 / substeps, steps = 2 * 19 * 9.8 * h * h / 0.05;
        EXPECT_LT(largestStretch(system.store()), springs + steps);
        EXPECT_GT(largestStretch(system.store()), 0);
        EXPECT_LT(largestStretch(system.store()), before);
        before = largestStretch(system.store());
    }
    EXPECT_LT(before, 0.05);
}

/// Smallest distance from a point, and smallest height, over all steps; the stretch after the last one.
struct Fall {
    double nearest = 1e9, lowest = 1e9, stretch = 0;

    Fall(const std::string& toml, int steps, const glm::vec3& centre) {
        auto system = test::systemFrom(toml);
        scene::Scene scene;
        scene.wind = {2, 0, 1};
        for (int i = 0; i < steps; ++i) {
            test::advance(system, scene, 1, 0, 0, 1.0 / 60, i);
            for (std::size_t k = 0; k < system.store().size(); ++k) {
                const glm::vec3 x = system.store().position(k);
                nearest = std::min(nearest, static_cast<double>(glm::distance(x, centre)));
                lowest = std::min(lowest, static_cast<double>(x.y));
            }
        }
        stretch = largestStretch(system.store());
    }
};

constexpr const char* onBall =
    "{ part = \"wind\", gust_speed = 1 }, { part = \"sail\", area_density = 1 }, { part = \"drag\", rate_per_second = "
    "0.5 }, "
    "{ part = \"bounce\", shape = \"sphere\", place = [0, 1, 0], radius_metres = 0.4, restitution = 0, friction = 0.5 "
    "}, "
    "{ part = \"bounce\", shape = \"scene\", restitution = 0, friction = 0.5 }";
constexpr const char* level = "place = [-0.575, 1.5, -0.475], row_step = [0, 0, 0.05]";

TEST(Cloth, NoPointEntersTheBallOrTheGround) {
    const Fall fall(sheet(level, "substeps = 10", onBall), 360, {0, 1, 0});
    EXPECT_GE(fall.nearest, 0.4);
    EXPECT_LT(fall.nearest, 0.4001);
    EXPECT_GE(fall.lowest, 0);
    EXPECT_LT(fall.stretch, 0.1);
}

TEST(Cloth, DoesNotPassThroughABallAtAnySpeed) {
    for (const double speed : {10, 60}) {
        const Fall fall(
            sheet(level, "substeps = 5", onBall,
                  "part = \"fixed\", direction = [0, -1, 0], variation = 0, speed = " + std::to_string(speed)),
            60, {0, 1, 0});
        EXPECT_GE(fall.nearest, 0.4) << speed;
        EXPECT_GE(fall.lowest, 0) << speed;
    }
}

TEST(Cloth, SailsWithTheWindAndNotAlongIt) {
    // A free sheet across the wind takes its speed: dw/dt = −r·w², w = w₀/(1 + r·w₀·t). Along it, nothing happens.
    const double r = 0.5 * 1.2 / 0.5, w0 = 3;
    for (const bool across : {true, false}) {
        auto system = test::systemFrom(test::with(sheet("row_step = [0, -0.05, 0]", "substeps = 2",
                                                        "{ part = \"wind\" }, { part = \"sail\", area_density = 0.5 }"),
                                                  "acceleration = 9.8", "acceleration = 0"));
        scene::Scene scene;
        scene.wind = across ? glm::vec3(0, 0, 3) : glm::vec3(3, 0, 0);
        test::advance(system, scene, 61, 0);
        double mean = 0;
        for (std::size_t i = 0; i < 480; ++i) mean += static_cast<double>(system.store().velocityZ[i]) / 480;
        EXPECT_NEAR(mean, across ? w0 - w0 / (1 + r * w0) : 0, 0.02);
    }
}

TEST(Flag, IsCarriedByTheVehicleAndStreamsBehindIt) {
    auto system = test::systemFrom(test::with(
        test::with(
            sheet(
                "frame = \"vehicle\", place = [-0.5, 2, 0], row_step = [0, -0.05, 0]",
                "pins = \"column\", substeps = 20",
                "{ part = \"wind\", gust_speed = 1 }, { part = \"sail\" }, { part = \"drag\", rate_per_second = 0.5 }",
                "part = \"cone\", speed = 0, speed_share = 0, variation = 0, inherit = 1"),
            "column_step = [0.05, 0, 0]", "column_step = [-0.05, 0, 0]"),
        "stiffness = 500", "stiffness = 5000"));
    scene::Scene scene = test::sceneWithCar();
    scene.wind = glm::vec3(0);
    test::advance(system, scene, 300, 20);
    const ParticleStore& s = system.store();
    ASSERT_EQ(s.size(), 480u);
    for (std::size_t row = 0; row < 20; ++row) {
        const glm::dvec3 pin = glm::dvec3(300 / 60.0 * 20 - 0.5, 2 - 0.05 * static_cast<double>(row), 0);
        EXPECT_LT(glm::distance(glm::dvec3(s.position(24 * row)), pin), 1e-4);
        EXPECT_NEAR(s.velocityX[24 * row], 20, 1e-2);
        EXPECT_LT(s.x[24 * row + 23], s.x[24 * row] - 0.8f);
    }
    EXPECT_LT(largestStretch(s), 0.15);
}

TEST(LatticeSurface, OfABlockIsClosedAndItsNormalsLookOutwards) {
    Lattice lattice;
    lattice.points = {4, 5, 3};
    lattice.column = {1, 0, 0}, lattice.row = {0, 1, 0}, lattice.layer = {0, 0, 1};
    std::vector<std::uint64_t> serials(lattice.size());
    for (std::size_t i = 0; i < serials.size(); ++i) serials[i] = i;
    LatticeSurface surface;
    EXPECT_TRUE(surface.follow(lattice, serials));
    EXPECT_FALSE(surface.follow(lattice, serials));
    const auto position = [&](std::uint32_t i) { return glm::vec3(lattice.restOf(serials[i])); };
    double volume = 0;  // a closed surface: Σ a·(b × c)/6 is that of the block
    const auto triangles = surface.triangles();
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        std::array<glm::vec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) corner[k] = position(surface.vertices()[triangles[t + k]].particle);
        volume += static_cast<double>(glm::dot(corner[0], glm::cross(corner[1], corner[2]))) / 6;
    }
    EXPECT_NEAR(volume, 3 * 4 * 2, 1e-4);
    for (const auto& vertex : surface.vertices()) {
        const glm::vec3 outwards = position(vertex.particle) - glm::vec3(1.5f, 2, 1);
        EXPECT_GT(glm::dot(LatticeSurface::normalOf(vertex, position), outwards), 0);
    }
}

}  // namespace
}  // namespace dustbench::particles
