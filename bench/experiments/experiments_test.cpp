#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <random>

#include "bench/experiments/birth_experiment.h"
#include "bench/experiments/experiment.h"
#include "bench/experiments/obstacle_experiment.h"
#include "bench/experiments/sight_experiment.h"
#include "bench/experiments/solid_space.h"
#include "methods/shared/errors.h"
#include "methods/shared/test_folder.h"

namespace dustbench::bench {
namespace {

std::map<std::string, Finding> sampled(std::uint64_t seed) {
    std::map<std::string, Finding> byName;
    for (Finding& finding : runExperiment("sampling", seed)) byName[finding.quantity] = finding;
    return byName;
}

/// sup |F(x) − x| for β = a + √u·(b − a), on a fine grid: F(x) = ((β(x) − a)/(b − a))², cos β(x) = cos a − x·(cos a −
/// cos b).
double distanceInCone(double leastDegrees, double mostDegrees) {
    const double a = leastDegrees * std::numbers::pi / 180, b = mostDegrees * std::numbers::pi / 180;
    double most = 0;
    for (int i = 1; i < 10'000; ++i) {
        const double x = i / 10'000.0;
        const double share = (std::acos(std::cos(a) - x * (std::cos(a) - std::cos(b))) - a) / (b - a);
        most = std::max(most, std::abs(share * share - x));
    }
    return most;
}

TEST(SamplingExperiment, IntervalsHoldTheClosedForms) {
    const std::map<std::string, double> truths{
        {"acceptance", std::numbers::pi / 6}, {"corner_over_face_gaussian", 1},
        {"chi2_per_cell_gaussian", 1},        {"cone30", distanceInCone(0, 30)},
        {"cone90", distanceInCone(0, 90)},    {"nested20_30", distanceInCone(20, 30)}};
    int misses = 0;
    std::map<std::string, Finding> found;
    for (const std::uint64_t seed : {1u, 2u}) {
        found = sampled(seed);
        for (const auto& [name, truth] : truths) misses += truth < found.at(name).low || truth > found.at(name).high;
    }
    EXPECT_LE(misses, 1) << "of 12 intervals, of which 5 % miss";
    EXPECT_DOUBLE_EQ(found.at("tries_per_point").value * found.at("acceptance").value, 1);
    // Density grows as the cube of the distance to the cube's surface: 3√3 at the very corner, less over a cap.
    EXPECT_GT(found.at("corner_over_face_cube").low, 4);
    EXPECT_LT(found.at("corner_over_face_cube").high, 3 * std::numbers::sqrt3);
    EXPECT_GT(found.at("chi2_per_cell_cube").low, 100);
    for (const char* cone : {"cone30_by_cosine", "cone90_by_cosine", "nested20_30_by_cosine"})
        EXPECT_LT(found.at(cone).value, 0.002) << cone;
}

TEST(SamplingExperiment, IsAFunctionOfItsSeed) {
    const std::string first = findingsCsv(runExperiment("sampling", 1));
    EXPECT_EQ(findingsCsv(runExperiment("sampling", 1)), first);
    EXPECT_NE(findingsCsv(runExperiment("sampling", 2)), first);
}

TEST(ObstacleExperiment, TellsAnObstacleFromNoneAndFromOneThatSwallowsTheStream) {
    const ObstacleReport holds = blowAtAnObstacle({});
    EXPECT_LT(holds.swallowed, 0.02);
    EXPECT_EQ(holds.smokeInside, 0);
    ObstacleSettings settings;
    settings.isSolid = false;
    EXPECT_GT(blowAtAnObstacle(settings).smokeInside, 0.5);
    // Without a pressure nothing turns the stream aside.
    settings = {fluid::PressureMethod::jacobi, 0};
    EXPECT_GT(blowAtAnObstacle(settings).swallowed, 0.3);
}

TEST(SightExperiment, FindsWhatIsDrawnWrong) {
    std::map<std::string, double> errors;
    for (const Finding& finding : runExperiment("sight")) errors[finding.quantity] = finding.value;
    ASSERT_EQ(errors.size(), 6u);
    for (const auto& [name, error] : errors) EXPECT_LT(error, 1e-4) << name;
    // A ray that ends at an alpha of a half leaves the other half out.
    gpu::Device device;
    raycast::RaycastSettings settings;
    settings.stopAlpha = 0.5;
    EXPECT_GT(greatestSightError(device, settings, {{{0, 0, 9}, {0, 0, -1}, {}}}), 0.1);
}

/// A cube of edge 2 around the origin, wound counter-clockwise as seen from outside.
scene::Mesh cube() {
    scene::Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.emplace_back(corner & 4 ? 1 : -1, corner & 2 ? 1 : -1, corner & 1 ? 1 : -1);
    mesh.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                    2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    return mesh;
}

TEST(SolidSpace, IsWhatLiesWithinASolidWhereverItStands) {
    scene::Scene scene;
    scene::SolidPose pose;
    pose.toWorld = glm::rotate(glm::translate(glm::mat4(1), {5, 1, 0}), 0.6f, {0.6f, 0.8f, 0});
    scene.solids = {{"here", std::make_shared<scene::Mesh>(cube())}, {"there", std::make_shared<scene::Mesh>(cube())}};
    scene.solidPoses = {scene::SolidPose(), pose};
    const SolidSpace space(scene);
    const glm::dmat4 toThere = glm::inverse(glm::dmat4(pose.toWorld));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> along(-2.5, 8);
    int within = 0;
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 point(along(random), along(random) / 2, along(random) / 2);
        const auto inCube = [](const glm::dvec3& p) { return glm::all(glm::lessThan(glm::abs(p), glm::dvec3(1))); };
        const bool expected = inCube(point) || inCube(glm::dvec3(toThere * glm::dvec4(point, 1)));
        ASSERT_EQ(space.contains(point), expected) << point.x << ' ' << point.y << ' ' << point.z;
        within += expected;
    }
    EXPECT_GT(within, 500);
}

TEST(BirthExperiment, FindsNoneInSolidsThatTheMethodKnowsAndManyInThoseItDoesNot) {
    gpu::Device device;
    const BirthReport told = driveThroughWalls(device, true, 1.4), untold = driveThroughWalls(device, false, 1.4);
    EXPECT_EQ(told.inSolids, 0);
    EXPECT_GT(told.births, 100'000);
    EXPECT_GT(untold.inSolids, 500);
}

TEST(Findings, AreReadAsTheyWereWritten) {
    const TestFolder folder;
    EXPECT_TRUE(readFindings(folder.path()).empty());
    const std::vector<Finding> written{{"sampling", "acceptance", 0.5236, 0.52, 0.53, 1000}};
    folder.write("experiments.csv", findingsCsv(written));
    const std::vector<Finding> read = readFindings(folder.path());
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].quantity, "acceptance");
    EXPECT_EQ(read[0].value, 0.5236);
    EXPECT_EQ(read[0].samples, 1000);
    EXPECT_THROW((void)runExperiment("smapling"), InputError);
}

}  // namespace
}  // namespace dustbench::bench
