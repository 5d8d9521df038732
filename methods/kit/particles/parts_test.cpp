// Compares each part with closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "methods/kit/maths/bezier.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/test_world.h"

namespace dustbench::particles {
namespace {

/// A particle system with a single source in still air; tests add the forces that they examine.
const std::string still = R"(
emission = { part = "stream", rate_per_second = 100, rate_per_metre = 0 }
position = { part = "point", at = "place", place = [1, 50, 2] }
velocity = { part = "cone", direction = [1, 0, 0], half_angle_degrees = 0, speed = 3, variation = 0 }
colour = { part = "constant", opacity_curve = "linear", opacity_start = 0.5, opacity_end = 0.1 }
size = { part = "constant", radius_metres = 0.5 }
life = [ { part = "lifetime", average_seconds = 1000, variation_seconds = 0 } ]
)";

ParticleSystem runFor(double seconds, double stepSeconds, const std::string& toml, const scene::Scene& scene) {
    auto system = test::systemFrom(toml);
    const int steps = static_cast<int>(std::lround(seconds / stepSeconds));
    for (int i = 1; i <= steps; ++i) {
        scene::SceneState state;
        state.timeSeconds = i * stepSeconds;
        system.update({scene, state, stepSeconds, 0});
    }
    return system;
}

TEST(Integration, FreeParticlesAreWhereTheirAgeAndSpeedPutThem) {
    const auto system = runFor(2, 1.0 / 64, still, scene::Scene{});
    const ParticleStore& store = system.store();
    ASSERT_EQ(store.size(), 200u);
    for (std::size_t i = 0; i < store.size(); ++i) {
        EXPECT_NEAR(store.x[i], 1 + 3 * store.age[i], 2e-5);
        EXPECT_NEAR(store.age[i], 2 - (static_cast<double>(store.serial[i]) + 1) / 100, 1e-5);
        EXPECT_EQ(store.y[i], 50);
        EXPECT_EQ(store.z[i], 2);
    }
}

/// Maximum |y − closed form| after two seconds, over particles born at the start of a step.
double fallError(double stepSeconds, double rate, double acceleration) {
    const std::string toml = test::with(still, "rate_per_second = 100", "rate_per_second = 16") +
                             "force = [ { part = \"gravity\", acceleration = " + std::to_string(acceleration) +
                             " }, { part = \"drag\", rate_per_second = " + std::to_string(rate) + " } ]";
    const auto system = runFor(2, stepSeconds, toml, scene::Scene{});
    double worst = 0;
    for (std::size_t i = 0; i < system.store().size(); ++i) {
        const double t = static_cast<double>(system.store().age[i]);
        // dv/dt = −g − k·v: y = −(g/k)·(t − (1 − e^{−kt})/k), and −gt²/2 without drag
        const double fall =
            rate > 0 ? acceleration / rate * (t + std::expm1(-rate * t) / rate) : acceleration * t * t / 2;
        worst = std::max(worst, std::abs(50 - fall - static_cast<double>(system.store().y[i])));
    }
    return worst;
}

TEST(Gravity, FallConvergesToTheParabolaAtFirstOrder) {
    const double coarse = fallError(1.0 / 32, 0, 9.8), fine = fallError(1.0 / 64, 0, 9.8);
    EXPECT_LT(fine, 0.2);
    EXPECT_NEAR(std::log2(coarse / fine), 1, 0.1);
}

TEST(Drag, FallWithDragConvergesToTheClosedFormAtFirstOrder) {
    const double coarse = fallError(1.0 / 32, 2, 9.8), fine = fallError(1.0 / 64, 2, 9.8);
    EXPECT_LT(fine, 0.1);
    EXPECT_NEAR(std::log2(coarse / fine), 1, 0.15);
}

TEST(Drag, LastSpeedOfAFallIsGravityOverRateWhateverTheStep) {
    for (const double step : {1.0 / 8, 1.0 / 60}) {
        const auto system = runFor(10, step,
                                   still +
                                       "force = [ { part = \"gravity\", acceleration = 3 }, "
                                       "{ part = \"drag\", rate_per_second = 2 } ]",
                                   scene::Scene{});
        for (std::size_t i = 0; i < system.store().size(); ++i)
            if (system.store().age[i] > 8) {
                EXPECT_NEAR(system.store().velocityY[i], -1.5, 1e-4);
            }
    }
}

TEST(Drag, IsStableAtAnyRateAndTakesOnTheWindsVelocity) {
    scene::Scene scene;
    scene.wind = {0, 1, -4};
    const auto system = runFor(1, 1.0 / 60,
                               still +
                                   "force = [ { part = \"drag\", rate_per_second = 100000 }, "
                                   "{ part = \"wind\", factor = 0.5 } ]",
                               scene);
    for (std::size_t i = 0; i < system.store().size(); ++i) {
        if (system.store().age[i] < 0.1f) continue;
        EXPECT_NEAR(system.store().velocityX[i], 0, 1e-4);
        EXPECT_NEAR(system.store().velocityY[i], 0.5, 1e-4);
        EXPECT_NEAR(system.store().velocityZ[i], -2, 1e-4);
    }
}

TEST(Forces, TheirOrderInTheListDoesNotMatter) {
    scene::Scene scene;
    scene.wind = {1, 0, 2};
    const std::string wind = "{ part = \"wind\", gust_speed = 1 }", drag = "{ part = \"drag\" }";
    const auto first = runFor(1, 1.0 / 60, still + "force = [ " + wind + ", " + drag + " ]", scene);
    const auto second = runFor(1, 1.0 / 60, still + "force = [ " + drag + ", " + wind + " ]", scene);
    EXPECT_EQ(first.stateHash(), second.stateHash());
}

TEST(Stream, CountsArriveOnTimeWhateverTheStep) {
    for (const double rate : {0.1, 7.3, 100.0, 12345.6})
        for (const double step : {0.5, 1.0 / 60, 0.001}) {
            const auto part =
                makePartOf<EmissionPart>(PartKind::emission, "stream", {{"rate_per_second", std::to_string(rate)}});
            std::int64_t count = 0;
            double time = 0, last = -1;
            const scene::Scene scene;
            const scene::SceneState state;
            for (int i = 0; i < 2000; ++i) {
                const Births births = part->births({scene, state, step, 1, 0, {}});
                for (std::int64_t k = 0; k < births.count; ++k) {
                    const double at = time + births.firstSeconds + static_cast<double>(k) * births.spacingSeconds;
                    EXPECT_GE(births.firstSeconds, 0);
                    EXPECT_LE(at, time + step + 1e-9);
                    if (last >= 0) {
                        ASSERT_NEAR(at - last, 1 / rate, 1e-6 / rate + 1e-9);
                    }
                    last = at;
                }
                count += births.count;
                time += step;
                ASSERT_LT(std::abs(static_cast<double>(count) - rate * time), 1 + 1e-6 * rate * time);
            }
        }
}

TEST(Stream, RateGrowsWithTheSpeedOfTheVehicle) {
    const auto scene = test::sceneWithCar();
    for (const double speed : {0.0, 5.0, 30.0}) {
        auto system = test::systemFrom(test::with(test::everyForce, "average_seconds = 0.8", "average_seconds = 100"));
        test::advance(system, scene, 120, speed);
        EXPECT_NEAR(static_cast<double>(system.store().size()), 2 * (30 + 25 * speed), 1);
    }
}

TEST(Sources, BirthsLieEvenlyAlongTheWheelsWayHoweverFastTheCar) {
    std::string toml = test::with(test::everyForce, "position = { part = \"disc\", radius_metres = 0.2 }",
                                  "position = { part = \"point\" }");
    toml = test::with(toml, "speed = 0.5, speed_share = 0.15", "speed = 0, speed_share = 0");
    toml = test::with(toml, "inherit = 0.2", "inherit = 0");
    toml = toml.substr(0, toml.find("force = ["));
    toml = test::with(toml, "average_seconds = 0.8", "average_seconds = 100");
    toml = test::with(toml, "rate_per_second = 30", "rate_per_second = 0");
    auto system = test::systemFrom(toml);
    test::advance(system, test::sceneWithCar(), 60, 60);
    std::map<int, std::vector<double>> ways;
    for (std::size_t i = 0; i < system.store().size(); ++i)
        ways[static_cast<int>(system.store().serial[i] % 4)].push_back(static_cast<double>(system.store().x[i]));
    ASSERT_EQ(ways.size(), 4u);
    for (auto& [wheel, way] : ways) {
        std::ranges::sort(way);
        ASSERT_GT(way.size(), 300u);
        for (std::size_t i = 1; i < way.size(); ++i) EXPECT_NEAR(way[i] - way[i - 1], 4.0 / 25, 1e-3);
    }
}

TEST(Sources, NothingIsBornWithoutAVehicle) {
    auto system = test::systemFrom(test::everyForce);
    test::advance(system, scene::Scene{}, 60);
    EXPECT_TRUE(system.store().empty());
}

TEST(Disc, BirthsLieInTheDiscAroundTheContacts) {
    std::string toml = test::with(test::everyForce, "speed = 0.5, speed_share = 0.15", "speed = 0, speed_share = 0");
    toml = test::with(test::with(toml, "inherit = 0.2", "inherit = 0"), "size = { part = \"linear\" }",
                      "size = { part = \"constant\", radius_metres = 0 }");
    toml = toml.substr(0, toml.find("force = ["));
    auto system = test::systemFrom(toml);
    test::advance(system, test::sceneWithCar(), 200, 0.0, 4000);
    double farthest = 0, sum = 0;
    for (std::size_t i = 0; i < system.store().size(); ++i) {
        const glm::dvec3 at = system.store().position(i);
        const double x = at.x > 1.3 ? at.x - 2.6 : at.x, z = std::abs(at.z) - 0.75;
        farthest = std::max(farthest, std::hypot(x, z));
        sum += x * x + z * z;
        EXPECT_EQ(at.y, 0);
    }
    EXPECT_LE(farthest, 0.2 + 1e-6);
    // ⟨r²⟩ = R²/2 on a disc
    EXPECT_NEAR(sum / static_cast<double>(system.store().size()), 0.02, 0.001);
}

TEST(Cone, SpeedFollowsTheCarAndAShareOfItsVelocityIsKept) {
    std::string toml = test::everyForce.substr(0, test::everyForce.find("force = ["));
    toml = test::with(toml, "variation = 0.6", "variation = 0");
    auto system = test::systemFrom(toml);
    test::advance(system, test::sceneWithCar(), 60, 20);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(-0.5, 0.8, 0.1));
    for (std::size_t i = 0; i < system.store().size(); ++i) {
        const glm::dvec3 own{static_cast<double>(system.store().velocityX[i]) - 0.2 * 20, system.store().velocityY[i],
                             system.store().velocityZ[i]};
        EXPECT_NEAR(glm::length(own), 0.5 + 0.15 * 20, 1e-4);
        EXPECT_GE(glm::dot(own, axis) / glm::length(own), std::cos(50 * 3.14159265 / 180) - 1e-5);
    }
}

TEST(Colour, LinearAndBezierFollowTheShareOfLife) {
    const std::string linear =
        test::with(still, "colour = { part = \"constant\", opacity_curve = \"linear\", ",
                   "colour = { part = \"linear\", start = [1, 0.5, 0], end = [0, 1, 2], opacity_curve = \"linear\", ");
    const std::string curve =
        test::with(test::with(linear, "part = \"linear\"", "part = \"bezier\", early = [1, 1, 1], late = [2, 3, 4]"),
                   "opacity_curve = \"linear\"", "opacity_curve = \"bezier\", opacity_early = 0.9, opacity_late = 0.3");
    for (const bool isCurve : {false, true}) {
        const auto system =
            runFor(2, 1.0 / 64, test::with(isCurve ? curve : linear, "average_seconds = 1000", "average_seconds = 2"),
                   scene::Scene{});
        const ParticleStore& store = system.store();
        ASSERT_FALSE(store.uniformColour);
        ASSERT_GT(store.size(), 100u);
        const auto value = [&](double a, double b, double c, double d, double t) {
            const double s = 1 - t;
            return isCurve ? s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d : s * a + t * d;
        };
        for (std::size_t i = 0; i < store.size(); ++i) {
            const double t = static_cast<double>(store.age[i] / store.lifetime[i]);
            EXPECT_NEAR(store.red[i], value(1, 1, 2, 0, t), 1e-5);
            EXPECT_NEAR(store.green[i], value(0.5, 1, 3, 1, t), 1e-5);
            EXPECT_NEAR(store.colour(i).b, value(0, 1, 4, 2, t), 1e-5);
            EXPECT_NEAR(store.opacity[i], value(0.5, 0.9, 0.3, 0.1, t), 1e-6);
        }
    }
}

TEST(Colour, CurvesOfSixPointsFollowTheShareOfLifeInEachChannel) {
    const auto system =
        runFor(2, 1.0 / 64,
               test::with(test::with(still,
                                     "colour = { part = \"constant\", opacity_curve = \"linear\", opacity_start = 0.5, "
                                     "opacity_end = 0.1 }",
                                     "colour = { part = \"bezier_points\", points = 6, point_1 = [1, 0, 0, 0], "
                                     "point_2 = [0, 2, 0, 0.9], point_3 = [3, 0, 1, 0.9], point_4 = [0, 0, 4, 0.1], "
                                     "point_5 = [1, 1, 0, 0.5], point_6 = [0, 0.5, 2, 0], point_7 = [9, 9, 9, 0.9] }"),
                          "average_seconds = 1000", "average_seconds = 2"),
               scene::Scene{});
    const ParticleStore& store = system.store();
    ASSERT_GT(store.size(), 100u);
    for (std::size_t i = 0; i < store.size(); ++i) {
        const float t = store.age[i] / store.lifetime[i];
        EXPECT_NEAR(store.red[i], maths::bezier(std::array{1.0f, 0.0f, 3.0f, 0.0f, 1.0f, 0.0f}, t), 1e-5);
        EXPECT_NEAR(store.green[i], maths::bezier(std::array{0.0f, 2.0f, 0.0f, 0.0f, 1.0f, 0.5f}, t), 1e-5);
        EXPECT_NEAR(store.blue[i], maths::bezier(std::array{0.0f, 0.0f, 1.0f, 4.0f, 0.0f, 2.0f}, t), 1e-5);
        EXPECT_NEAR(store.opacity[i], maths::bezier(std::array{0.0f, 0.9f, 0.9f, 0.1f, 0.5f, 0.0f}, t), 1e-6);
    }
}

TEST(Size, LinearGrowsAndRandomStaysAsDrawn) {
    const auto grown = runFor(2, 1.0 / 64,
                              test::with(still, "size = { part = \"constant\", radius_metres = 0.5 }",
                                         "size = { part = \"linear\", start_metres = 0.2, end_metres = 40 }"),
                              scene::Scene{});
    for (std::size_t i = 0; i < grown.store().size(); ++i)
        EXPECT_NEAR(grown.store().radius[i], 0.2 + 39.8 * static_cast<double>(grown.store().age[i]) / 1000, 1e-5);

    const std::string random = test::with(still, "size = { part = \"constant\", radius_metres = 0.5 }",
                                          "size = { part = \"random\", average_metres = 2, variation_metres = 0.5 }");
    const auto early = runFor(1, 1.0 / 64, random, scene::Scene{}), late = runFor(3, 1.0 / 64, random, scene::Scene{});
    double sum = 0;
    for (std::size_t i = 0; i < early.store().size(); ++i) {
        EXPECT_EQ(early.store().radius[i], late.store().radius[i]);
        EXPECT_GE(early.store().radius[i], 1.5f);
        EXPECT_LE(early.store().radius[i], 2.5f);
        sum += static_cast<double>(early.store().radius[i]);
    }
    // Mean of 100 draws of deviation 0.5/√3; 4 standard errors.
    EXPECT_NEAR(sum / static_cast<double>(early.store().size()), 2, 4 * 0.5 / std::sqrt(3 * 100.0));
}

}  // namespace
}  // namespace dustbench::particles
