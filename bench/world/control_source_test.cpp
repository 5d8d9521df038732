#include "bench/world/control_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bench/world/world.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::world {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double tick = 1.0 / 60;

Drive builtIn(const std::string& id) {
    return Drive::parseFile(files::findData("drive", "drives", id, ".csv"));
}

/// ∫ of the target speed over the whole drive, metres: exact if all rows lie at multiples of half a second.
double targetDistance(const Drive& drive) {
    constexpr double step = 0.5;
    double distance = 0;
    for (double t = 0; t < drive.seconds(); t += step)
        distance += (drive.targetSpeedAt(t) + drive.targetSpeedAt(t + step)) / 2 * step;
    return distance;
}

/// Drives the default vehicle on level ground and calls `each` with every state.
template <typename Each>
void driveIt(const Drive& drive, const Each& each) {
    const scene::VehicleParameters p;
    Driver driver;
    scene::VehicleState state = placeVehicle(p, {}, 0, 0, 0, drive.targetSpeedAt(0));
    for (int n = 0; n * tick < drive.seconds(); ++n) {
        const double now = n * tick, next = now + tick;
        const Controls controls =
            driver.decide(p, state, drive.targetSpeedAt(now), drive.targetSpeedAt(next), drive.steerAt(next), tick);
        state = step(p, state, controls, {}, tick);
        each(next, state);
    }
}

TEST(Drive, IsLinearBetweenRowsAndHeldOutside) {
    const Drive drive = Drive::parseText("time_s,throttle,brake,steer\n0,0,1,-1\n2,1,0,1\n", "d");
    EXPECT_FALSE(drive.followsSpeed());
    EXPECT_EQ(drive.throttleAt(-5), 0);
    EXPECT_EQ(drive.throttleAt(0.5), 0.25);
    EXPECT_EQ(drive.brakeAt(0.5), 0.75);
    EXPECT_EQ(drive.steerAt(1), 0);
    EXPECT_EQ(drive.steerAt(2), 1);
    EXPECT_EQ(drive.steerAt(99), 1);
    EXPECT_EQ(drive.seconds(), 2);
}

TEST(Drive, TakesItsColumnsInAnyOrder) {
    const Drive drive = Drive::parseText("steer,time_s,target_speed_mps\n0.5,0,10\n", "d");
    EXPECT_TRUE(drive.followsSpeed());
    EXPECT_EQ(drive.targetSpeedAt(7), 10);
    EXPECT_EQ(drive.steerAt(7), 0.5);
}

TEST(Drive, ReplacesOnlyTheSpeedsThatAreAboveZero) {
    Drive drive = Drive::parseText("time_s,target_speed_mps,steer\n0,0,0\n1,5,0\n2,0,0\n", "d");
    drive.replaceSpeeds(30);
    EXPECT_EQ(drive.targetSpeedAt(0), 0);
    EXPECT_EQ(drive.targetSpeedAt(1), 30);
    EXPECT_EQ(drive.targetSpeedAt(2), 0);
}

struct BadDrive {
    std::string text, start, part;
};

TEST(Drive, SaysFileLineAndWhatWasExpectedOfBadInput) {
    const std::string pedals = "time_s,throttle,brake,steer\n";
    const std::string speeds = "time_s,target_speed_mps,steer\n";
    for (const BadDrive& bad :
         {BadDrive{"", "d.csv:1: ", "empty"}, BadDrive{pedals, "d.csv:2: ", "no rows"},
          BadDrive{"time_s,gas\n0,1\n", "d.csv:1: ", "time_s,throttle,brake,steer"},
          BadDrive{pedals + "0,0,0,0\n1,0,0,1.5\n", "d.csv:3: ", "column 'steer': got 1.5, expected a number -1..1"},
          BadDrive{pedals + "0,2,0,0\n", "d.csv:2: ", "column 'throttle': got 2"},
          BadDrive{pedals + "0,0,nan,0\n", "d.csv:2: ", "column 'brake': got 'nan', expected a number"},
          BadDrive{pedals + "0,0,,0\n", "d.csv:2: ", "column 'brake'"},
          BadDrive{pedals + "0,0,0\n", "d.csv:2: ", "3 cells, expected 4"},
          BadDrive{speeds + "0,5,0\n2,5,0\n2,6,0\n", "d.csv:4: ", "column 'time_s': got 2, expected more than 2"},
          BadDrive{speeds + "0,5,0\n2,5,0\n1,6,0\n", "d.csv:4: ", "expected more than 2"},
          BadDrive{speeds + "3,5,0\n", "d.csv:2: ", "expected 0 in the first row"},
          BadDrive{speeds + "0,-1,0\n", "d.csv:2: ", "column 'target_speed_mps': got -1"}}) {
        const std::string message = inputError([&] { static_cast<void>(Drive::parseText(bad.text, "d.csv")); });
        EXPECT_THAT(message, StartsWith(bad.start));
        EXPECT_THAT(message, HasSubstr(bad.part));
    }
}

TEST(Drive, NamesTheNearestBuiltInDrive) {
    EXPECT_THAT(inputError([] { static_cast<void>(builtIn("strait")); }), HasSubstr("did you mean 'straight'?"));
}

TEST(BuiltInDrives, Ece15IsThePublishedUrbanCycle) {
    const Drive drive = builtIn("ece15");
    EXPECT_EQ(drive.seconds(), 195);
    double fastest = 0;
    for (double t = 0; t <= 195; t += 0.5) fastest = std::max(fastest, drive.targetSpeedAt(t));
    EXPECT_NEAR(fastest, 50 / 3.6, 1e-5);
    // The segments joined by straight lines: 3652.5 km/h·s. Published: 1013 m (theoretical), mean 18.7 km/h.
    EXPECT_NEAR(targetDistance(drive), 3652.5 / 3.6, 0.01);
    EXPECT_NEAR(targetDistance(drive), 1013, 0.002 * 1013);
    EXPECT_NEAR(targetDistance(drive) / 195 * 3.6, 18.7, 0.05);
}

TEST(BuiltInDrives, EudcIsThePublishedExtraUrbanCycle) {
    const Drive drive = builtIn("eudc");
    EXPECT_EQ(drive.seconds(), 400);
    EXPECT_NEAR(drive.targetSpeedAt(340), 120 / 3.6, 1e-5);
    EXPECT_NEAR(targetDistance(drive), 6955, 1);
}

TEST(BuiltInDrives, TheVehicleFollowsTheRealCycles) {
    for (const char* id : {"ece15", "eudc"}) {
        const Drive drive = builtIn(id);
        double travelled = 0;
        driveIt(drive, [&](double time, const scene::VehicleState& state) {
            ASSERT_NEAR(state.speed, drive.targetSpeedAt(time), 0.3) << id << " at " << time;
            travelled = state.position.x;
        });
        EXPECT_NEAR(travelled, targetDistance(drive), 0.002 * targetDistance(drive)) << id;
    }
}

TEST(BuiltInDrives, LastAMinuteOrMore) {
    for (const std::string& id : files::listData("drives", ".csv")) EXPECT_GE(builtIn(id).seconds(), 60) << id;
}

TEST(BuiltInDrives, StraightKeepsTwentyMetresASecond) {
    driveIt(builtIn("straight"), [](double time, const scene::VehicleState& state) {
        ASSERT_NEAR(state.speed, 20, 1e-6);
        ASSERT_NEAR(state.position.x, 20 * time, 1e-3);
        ASSERT_EQ(state.position.z, 0);
    });
}

TEST(BuiltInDrives, AccelerationReachesFortyFromRest) {
    double last = -1;
    driveIt(builtIn("acceleration"), [&](double time, const scene::VehicleState& state) {
        if (time < 18) {
            ASSERT_GE(state.speed, last - 1e-9);
        }
        last = state.speed;
    });
    EXPECT_NEAR(last, 40, 0.05);
}

TEST(BuiltInDrives, FigureOfEightReturnsToItsStartAfterEveryRound) {
    const Drive drive = builtIn("figure_of_eight");
    constexpr int rounds = 3;
    int returned = 0;
    double left = 0, right = 0;
    driveIt(drive, [&](double time, const scene::VehicleState& state) {
        left = std::min(left, state.position.z);
        right = std::max(right, state.position.z);
        const double inRound = std::fmod(time, drive.seconds() / rounds);
        if (inRound < tick && time > 1) {
            ++returned;
            EXPECT_LT(std::hypot(state.position.x, state.position.z), 0.5) << time;
            EXPECT_NEAR(std::remainder(state.heading, 2 * 3.14159265358979), 0, 0.02) << time;
        }
    });
    EXPECT_GE(returned, rounds - 1);
    EXPECT_LT(left, -20);
    EXPECT_GT(right, 20);
}

TEST(BuiltInDrives, SlalomSwingsToBothSidesAndKeepsItsDirection) {
    double heading = 0, maximum = 0, minimum = 0;
    int count = 0;
    driveIt(builtIn("slalom"), [&](double, const scene::VehicleState& state) {
        heading += state.heading;
        ++count;
        maximum = std::max(maximum, state.heading);
        minimum = std::min(minimum, state.heading);
    });
    EXPECT_NEAR(heading / count, 0, 0.01);
    EXPECT_GT(maximum, 0.15);
    EXPECT_LT(minimum, -0.15);
}

TEST(BuiltInDrives, StopAndGoStopsFourTimes) {
    int stops = 0;
    bool standing = true;
    driveIt(builtIn("stop_and_go"), [&](double, const scene::VehicleState& state) {
        if (state.speed == 0 && !standing) ++stops;
        standing = state.speed == 0;
    });
    EXPECT_EQ(stops, 4);
}

using scene::Terrain;
using scene::VehicleParameters;
using scene::VehicleState;

constexpr double driverTick = 1.0 / 60;

TEST(Driver, KeepsAConstantSpeed) {
    const VehicleParameters p;
    Driver driver;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 20);
    for (int n = 0; n < 3600; ++n) {
        state = step(p, state, driver.decide(p, state, 20, 20, 0, driverTick), {}, driverTick);
        ASSERT_NEAR(state.speed, 20, 1e-6);
    }
}

TEST(Driver, FollowsARampThatTheVehicleCanDrive) {
    const VehicleParameters p;
    Driver driver;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 0);
    const auto target = [](double t) { return t < 10 ? 2 * t : t < 20 ? 20 : std::max(0.0, 20 - 3 * (t - 20)); };
    for (int n = 0; n < 1800; ++n) {
        state =
            step(p, state, driver.decide(p, state, target(n * driverTick), target((n + 1) * driverTick), 0, driverTick),
                 {}, driverTick);
        ASSERT_NEAR(state.speed, target((n + 1) * driverTick), 0.05) << n;
    }
    EXPECT_EQ(state.speed, 0);
}

TEST(Driver, HoldsTheSpeedUpAHill) {
    const VehicleParameters p;
    const Terrain slope({0, 100, 0, 100}, 2, 2, 1000, 0, -500);
    Driver driver;
    VehicleState state = placeVehicle(p, slope, 10, 0, 0, 15);
    for (int n = 0; n < 1200; ++n)
        state = step(p, state, driver.decide(p, state, 15, 15, 0, driverTick), slope, driverTick);
    EXPECT_NEAR(state.speed, 15, 0.01);
}

TEST(Driver, DoesNotWindUpWhileTheTargetIsOutOfReach) {
    const VehicleParameters p;
    Driver driver;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 0);
    for (int n = 0; n < 240; ++n)
        state = step(p, state, driver.decide(p, state, 50, 50, 0, driverTick), {}, driverTick);
    double highest = 0;
    for (int n = 0; n < 1800; ++n) {
        state = step(p, state, driver.decide(p, state, 20, 20, 0, driverTick), {}, driverTick);
        highest = std::max(highest, state.speed);
    }
    EXPECT_LT(highest, 20.5);
    EXPECT_NEAR(state.speed, 20, 1e-3);
}

TEST(Driver, UsesOnePedalAtATimeWithinItsStops) {
    const VehicleParameters p;
    Driver driver;
    for (const double speed : {0.0, 3.0, 20.0, 50.0})
        for (const double target : {0.0, 5.0, 20.0, 60.0}) {
            const VehicleState state = placeVehicle(p, {}, 0, 0, 0, speed);
            const Controls controls = driver.decide(p, state, target, target, 0.25, driverTick);
            EXPECT_TRUE(controls.throttle == 0 || controls.brake == 0);
            EXPECT_GE(std::min(controls.throttle, controls.brake), 0);
            EXPECT_LE(std::max(controls.throttle, controls.brake), 1);
            EXPECT_EQ(controls.steer, 0.25);
        }
}

ParameterValues prerolled(const std::string& seconds) {
    ParameterValues values(worldParameters());
    values.set("preroll", seconds);
    return values;
}

TEST(KeyboardControls, StandsUntilTheDriveHasBegun) {
    const auto input = std::make_shared<DrivingInput>(DrivingInput{1, 0, 1});
    World world("plain", std::make_unique<KeyboardControls>(input), prerolled("1"), 1);
    for (std::int64_t n = 0; n <= world.prerollSteps(); ++n) {
        world.step();
        ASSERT_EQ(world.controls().throttle, 0) << n;
        ASSERT_EQ(world.state().vehicle.speed, 0) << n;
    }
    for (int n = 0; n < 60; ++n) world.step();
    EXPECT_GT(world.state().vehicle.speed, 2);
    EXPECT_GT(world.state().vehicle.heading, 0.01);  // to the left
}

TEST(KeyboardControls, SteersAtALimitedRateAndComesBack) {
    const auto input = std::make_shared<DrivingInput>();
    KeyboardControls controls(input);
    const auto steerAfter = [&](double wanted, int steps) {
        input->steer = wanted;
        double steer = 0;
        for (int n = 0; n < steps; ++n) steer = controls.decide({}, {}, 1).steer;
        return steer;
    };
    EXPECT_NEAR(steerAfter(1, 10), 0.5, 1e-12);
    EXPECT_EQ(steerAfter(1, 20), 1);
    EXPECT_NEAR(steerAfter(-0.25, 10), 0.5, 1e-12);
    EXPECT_EQ(steerAfter(-0.25, 20), -0.25);
    EXPECT_EQ(steerAfter(0, 60), 0);
}

TEST(KeyboardControls, ARecordingPlayedAgainIsTheSameDrive) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        for (const char* preroll : {"0", "1.5"}) {
            std::mt19937 random(seed);
            const auto input = std::make_shared<DrivingInput>(DrivingInput{1, 0, 1});
            World world("dunes", std::make_unique<KeyboardControls>(input), prerolled(preroll), seed);
            ControlRecording recording;
            const std::int64_t steps = world.prerollSteps() + 300;
            for (std::int64_t n = 0; n < steps; ++n) {
                if (n % 20 == 19)
                    *input = {static_cast<double>(random() % 4 > 0), static_cast<double>(random() % 5 == 0),
                              static_cast<double>(random() % 3) - 1};
                world.step();
                if (n >= world.prerollSteps()) recording.add(world.controls());
            }
            EXPECT_GT(world.state().vehicle.speed, 0.1);
            auto drive = std::make_unique<DriveControls>(Drive::parseText(recording.csv(), "recording.csv"));
            World again("dunes", std::move(drive), prerolled(preroll), seed);
            for (std::int64_t n = 0; n < steps; ++n) again.step();
            EXPECT_EQ(again.stateHash(), world.stateHash()) << seed << " preroll " << preroll;
        }
    }
}

}  // namespace
}  // namespace dustbench::world
