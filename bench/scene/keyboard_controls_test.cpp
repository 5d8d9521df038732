#include "bench/scene/keyboard_controls.h"

#include <gtest/gtest.h>

#include <random>

#include "bench/scene/control_recording.h"
#include "bench/scene/drive_controls.h"
#include "bench/scene/world.h"

namespace dustbench::bench {
namespace {

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
}  // namespace dustbench::bench
