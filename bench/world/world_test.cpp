#include "bench/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>

#include "bench/world/control_source.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::world {
namespace {

using ::testing::HasSubstr;

ParameterValues with(const std::map<std::string, std::string>& settings) {
    ParameterValues values(worldParameters());
    for (const auto& [name, value] : settings) values.set(name, value);
    return values;
}

void run(World& world, std::int64_t steps) {
    for (std::int64_t n = 0; n < steps; ++n) world.step();
}

std::uint64_t hashAfter(const std::string& scene, std::uint64_t seed, std::int64_t steps) {
    World world(scene, "", with({{"preroll", "0.5"}}), seed);
    run(world, steps);
    return world.stateHash();
}

TEST(World, GivesTheSameStateAtEveryNumberOfThreads) {
    const std::uint64_t expected = hashAfter("plain", 7, 90);
    for (const std::size_t threads : {1u, 2u, 5u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_EQ(hashAfter("plain", 7, 90), expected) << threads;
    }
}

TEST(World, GivesAnotherStateForAnotherSeedSceneOrMoment) {
    const std::uint64_t expected = hashAfter("plain", 7, 60);
    EXPECT_NE(hashAfter("plain", 8, 60), expected);
    EXPECT_NE(hashAfter("dunes", 7, 60), expected);
    EXPECT_NE(hashAfter("plain", 7, 61), expected);
}

TEST(World, PuffsPerMetreAreBornAtAnySpeed) {
    for (const auto& [speed, perMetre] : {std::pair(20, 2.5), std::pair(10, 2.5), std::pair(10, 30.0)}) {
        const auto parameters =
            with({{"speed", std::to_string(speed)}, {"puffs_per_metre", std::to_string(perMetre)}, {"preroll", "5"}});
        World world("carr_plain", "", parameters, 1);
        run(world, world.prerollSteps());
        EXPECT_NEAR(static_cast<double>(world.dust().size()), speed * perMetre * 4, 2) << "each lives for 4 s";
    }
    const auto fixed = with({{"particles", "100"}, {"puffs_per_metre", "2.5"}});
    EXPECT_THAT(inputError([&] { World("carr_plain", "", fixed, 1); }),
                testing::AllOf(HasSubstr("puffs_per_metre: got 2.5"), HasSubstr("particles=100")));
}

TEST(World, PuffsPerMetreOfTheFileGiveItsOwnState) {
    const auto after = [](const std::map<std::string, std::string>& settings) {
        World world("carr_plain", "", with(settings), 1);
        run(world, 90);
        return world.stateHash();
    };
    EXPECT_EQ(after({{"preroll", "1"}, {"puffs_per_metre", "10"}}), after({{"preroll", "1"}}));
    EXPECT_NE(after({{"preroll", "1"}, {"puffs_per_metre", "9"}}), after({{"preroll", "1"}}));
}

TEST(World, SolidsGoByTheTimeAloneAndCountAmongItsState) {
    const TestFolder folder;
    const std::string head = "description = \"\"\n[[solid]]\nname = \"ball\"\nmesh = \"meshes/sphere.obj\"\n";
    const std::string key = "[[solid.key]]\ntime_seconds = ";
    const auto file =
        folder.write("moving.toml", head + "keys_repeat = true\n" + key + "0\n" + key +
                                        "0.5\nposition = [3, 1, 2]\nrotation_degrees = [0, 90, 0]\n" + key + "1\n");
    World world(file.string(), "", with({{"preroll", "0.5"}}), 7);
    const auto place = [&] { return glm::vec3(world.state().solids.at(0).pose.toWorld[3]); };
    EXPECT_EQ(place(), glm::vec3(3, 1, 2)) << "at -0.5 s";
    run(world, 45);  // to 0.25 s
    EXPECT_LT(glm::distance(place(), glm::vec3(1.5f, 0.5f, 1)), 1e-5f);
    const glm::vec3 before = place(), velocity = world.state().solids[0].pose.velocity;
    world.step();
    EXPECT_LT(glm::distance((place() - before) * 60.0f, velocity), 0.1f);
    EXPECT_GT(glm::length(velocity), 5);
    EXPECT_EQ(World("plain", "", with({}), 7).state().solids.size(), 0u);

    for (const std::size_t threads : {1u, 3u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        World again(file.string(), "", with({{"preroll", "0.5"}}), 7);
        run(again, 46);
        EXPECT_EQ(again.stateHash(), world.stateHash()) << threads;
    }
    const auto still = folder.write("moving.toml", head);
    World other(still.string(), "", with({{"preroll", "0.5"}}), 7);
    run(other, 46);
    EXPECT_NE(other.stateHash(), world.stateHash());
}

TEST(World, ARecordingPlayedAgainEndsInTheSameState) {
    for (const char* drive : {"acceleration", "stop_and_go"}) {  // start at rest, like a pedal file
        World world("plain", drive, with({{"preroll", "0"}}), 5);
        ControlRecording recording;
        for (int step = 0; step < 300; ++step) {
            world.step();
            recording.add(world.controls());
        }
        const auto replay = [&](const ControlRecording& played) {
            auto source = std::make_unique<DriveControls>(Drive::parseText(played.csv(), "recording.csv"));
            World again("plain", std::move(source), with({{"preroll", "0"}}), 5);
            run(again, 300);
            return again.stateHash();
        };
        EXPECT_EQ(replay(recording), world.stateHash()) << drive;
        ControlRecording other;
        for (int step = 0; step < 300; ++step) other.add({0.5, 0, 0.001});
        EXPECT_NE(replay(other), world.stateHash()) << drive;
    }
}

TEST(World, PrerollEndsAtTheStartWhenTheDriveBegins) {
    for (const char* drive : {"straight", "figure_of_eight", "slalom", "acceleration"}) {
        World world("plain", drive, with({{"preroll", "3"}}), 1);
        EXPECT_EQ(world.prerollSteps(), 180);
        EXPECT_NEAR(world.state().timeSeconds, -3, 1e-12);
        run(world, world.prerollSteps());
        EXPECT_EQ(world.state().timeSeconds, 0) << drive;
        EXPECT_NEAR(glm::length(world.state().vehicle.position), 0, 1e-6) << drive;
        EXPECT_NEAR(world.state().vehicle.heading, 0, 1e-9) << drive;
    }
}

TEST(World, PrerollHoldsTheControlsOfTimeZeroEvenInATurn) {
    const TestFolder folder;
    const auto drive = folder.write("turn.csv", "time_s,target_speed_mps,steer\n0,8,0.5\n60,8,0.5\n");
    World world("plain", drive.string(), with({{"preroll", "4"}}), 1);
    run(world, world.prerollSteps());
    EXPECT_NEAR(world.state().vehicle.position.x, 0, 1e-6);
    EXPECT_NEAR(world.state().vehicle.position.z, 0, 1e-6);
    EXPECT_NEAR(world.state().vehicle.heading, 0, 1e-9);
}

TEST(World, PrerollsOneMeanLifetimeByDefault) {
    const World world("plain", "", with({}), 1);
    EXPECT_GT(world.prerollSteps(), 0);
    EXPECT_GE(world.driveSeconds(), 60);
    EXPECT_EQ(world.driveId(), "straight");
}

TEST(World, KeepsTheWantedNumberOfParticlesAlive) {
    World world("plain", "", with({{"particles", "2000"}}), 3);
    run(world, 2 * world.prerollSteps() + 60);
    EXPECT_NEAR(static_cast<double>(world.dust().size()), 2000, 100);
}

TEST(World, RaisesManyParticlesInThePlaceOfEachForTheContinuum) {
    for (const char* particles : {"0", "300"}) {
        World one("plain", "", with({{"particles", particles}, {"preroll", "2"}}), 3);
        World many("plain", "", with({{"particles", particles}, {"preroll", "2"}}), 3, 64);
        run(one, 120);
        run(many, 120);
        // No particle has died yet, so only births count, and they are evenly spaced in time.
        EXPECT_NEAR(static_cast<double>(many.dust().size()), 64 * static_cast<double>(one.dust().size()), 64);
        EXPECT_EQ(many.state().vehicle.position, one.state().vehicle.position);
    }
    EXPECT_THROW(World("plain", "", with({}), 3, 0), std::invalid_argument);
}

TEST(World, RaisesNoDustWhereTheSceneSaysNone) {
    for (const char* particles : {"0", "300"}) {
        World world("void", "", with({{"particles", particles}}), 3);
        run(world, world.prerollSteps() + 30);
        EXPECT_EQ(world.dust().size(), 0u);
        EXPECT_EQ(world.setup().particles, std::stoi(particles));  // the method's own
        EXPECT_GT(world.state().vehicle.speed, 1);
    }
}

TEST(World, RaisesMoreDustTheFasterItDrives) {
    std::size_t before = 0;
    for (const char* speed : {"5", "15", "30"}) {
        World world("plain", "", with({{"speed", speed}, {"preroll", "2"}}), 3);
        run(world, world.prerollSteps());
        EXPECT_NEAR(world.state().vehicle.speed, std::stod(speed), 1e-6);
        EXPECT_GT(world.dust().size(), before);
        before = world.dust().size();
    }
}

TEST(World, FollowsTheDunesWithItsWheels) {
    World world("dunes", "", with({{"preroll", "1"}}), 3);
    double lowest = 0, highest = 0;
    for (int n = 0; n < 1200; ++n) {
        run(world, 1);
        const scene::VehicleState& vehicle = world.state().vehicle;
        lowest = std::min(lowest, vehicle.position.y);
        highest = std::max(highest, vehicle.position.y);
        ASSERT_GT(vehicle.up.y, 0.9);
        ASSERT_NEAR(vehicle.speed, 12, 1.5);
    }
    EXPECT_GT(highest - lowest, 0.5);
}

TEST(World, ShowsTheVehicleFromEveryCamera) {
    for (const char* camera : {"chase", "fixed", "orbit", "wheel"}) {
        World world("plain", "", with({{"camera", camera}, {"preroll", "1"}}), 1);
        run(world, world.prerollSteps() + 60);
        const scene::View view = world.view(640, 480);
        const glm::vec4 clip = view.worldToClip() * glm::vec4(glm::vec3(world.state().vehicle.position), 1);
        EXPECT_LT(std::abs(clip.x), clip.w) << camera;
        EXPECT_LT(std::abs(clip.y), clip.w) << camera;
    }
}

TEST(World, ACameraPathChangesTheViewAlone) {
    const TestFolder folder;
    const auto file = folder.write("path.csv", CameraPath({{0, {9, 8, 7}, {0, 1, 0}, 40}}).csv());
    World world("plain", "", with({{"preroll", "0.5"}}), 7);
    world.followPath(file.string());
    run(world, 90);
    EXPECT_EQ(world.stateHash(), hashAfter("plain", 7, 90));
    EXPECT_EQ(world.view(64, 48).camera.eye, glm::dvec3(9, 8, 7));
    EXPECT_EQ(world.inputFiles().back(), file);
    world.look(CameraKind::fixed);
    EXPECT_EQ(world.view(64, 48).camera.eye, glm::dvec3(48, 3, 18));
    EXPECT_THAT(inputError([&] { world.followPath("aside"); }), HasSubstr("camera path: got 'aside'"));
}

TEST(World, SunlightChangesColoursAloneAndByTheClosedForm) {
    World unlit("plain", "", with({{"preroll", "4"}, {"particles", "300"}}), 5);
    World lit("plain", "", with({{"preroll", "4"}, {"particles", "300"}, {"light", "sun"}}), 5);
    for (const scene::Scene* scene : {&unlit.scene(), &lit.scene()})
        EXPECT_EQ(scene->lights.onDust, scene == &lit.scene());
    run(unlit, 250);
    run(lit, 250);
    EXPECT_EQ(lit.stateHash(), unlit.stateHash());
    const Puffs before = unlit.dust(), after = lit.dust();
    ASSERT_EQ(after.size(), before.size());
    ASSERT_GT(after.size(), 200u);
    EXPECT_TRUE(before.uniformColour);
    EXPECT_TRUE(lit.unlitDust().uniformColour);
    ASSERT_FALSE(after.uniformColour);
    const glm::vec3 toSun = lit.scene().lights.toSun;
    const glm::dvec3 eye = lit.view(4, 3).camera.eye;
    float darkest = 1;
    for (std::size_t i = 0; i < after.size(); ++i) {
        ASSERT_EQ(after.position(i), before.position(i));
        double depth = 0;
        for (std::size_t k = 0; k < before.size(); ++k) {
            const glm::dvec3 toCentre = glm::dvec3(before.position(k)) - glm::dvec3(before.position(i));
            const double foot = glm::dot(toCentre, glm::dvec3(toSun));
            depth += maths::rayOpticalDepth(
                static_cast<double>(before.opacity[k]), static_cast<double>(before.radius[k]),
                std::sqrt(std::max(0.0, glm::dot(toCentre, toCentre) - foot * foot)), foot, 0, 1e9);
        }
        const glm::dvec3 sight = glm::normalize(glm::dvec3(before.position(i)) - eye);
        const float transmittance = static_cast<float>(std::exp(-depth));
        const glm::vec3 light =
            scene::dustLight(lit.scene(), transmittance, static_cast<float>(glm::dot(sight, glm::dvec3(toSun))));
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(after.colour(i)[c], before.colour(i)[c] * light[c], 4e-3f) << i;
        darkest = std::min(darkest, transmittance);
    }
    EXPECT_LT(darkest, 0.8f);
    // Another camera sees other colours, because light scatters forwards.
    const glm::vec3 seen = after.colour(0);
    lit.look(CameraKind::orbit);
    EXPECT_NE(lit.dust().colour(0), seen);
}

TEST(World, DustOfTwoSoilsHasTwoColoursInRows) {
    World world("two_soils", "", with({{"preroll", "2"}}), 5);
    run(world, 140);
    const Puffs dust = world.dust();
    ASSERT_FALSE(dust.uniformColour);
    std::map<std::uint64_t, glm::vec3> ofRow;
    std::size_t pale = 0;
    for (std::size_t i = 0; i < dust.size(); ++i) {
        const auto [row, isNew] = ofRow.emplace(dust.serial[i] / 100, dust.colour(i));
        ASSERT_EQ(row->second, dust.colour(i)) << dust.serial[i];
        pale += dust.red[i] > 0.5f ? 1 : 0;
    }
    EXPECT_GT(pale, dust.size() / 5);
    EXPECT_LT(pale, dust.size() * 4 / 5);
}

TEST(World, ACameraPathGoesByTheTimeOfTheDrive) {
    World world("plain", "", with({{"preroll", "1"}}), 1);
    world.followPath("0,0,5,20,0,1,0,50;2,8,5,20,8,1,0,50");
    run(world, 60);
    EXPECT_NEAR(world.view(64, 48).camera.eye.x, 0, 1e-9);  // the drive begins
    run(world, 60);
    EXPECT_NEAR(world.view(64, 48).camera.eye.x, 4, 1e-9);
}

TEST(World, NamesEveryInputFile) {
    const World world("dunes", "slalom", with({}), 1);
    std::string all;
    for (const auto& file : world.inputFiles()) {
        EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
        all += file.filename().string() + " ";
    }
    for (const char* part : {"dunes.toml", "dunes.png", "rock.obj", "slalom.csv", "wheel_dust.toml"})
        EXPECT_THAT(all, HasSubstr(part));
    EXPECT_FALSE(world.memory().empty());
}

TEST(World, SaysInOneLineWhatIsWrongWithItsInput) {
    EXPECT_THAT(inputError([] { World("plainn", "", with({}), 1); }), HasSubstr("did you mean 'plain'?"));
    EXPECT_THAT(inputError([] { World("plain", "slalon", with({}), 1); }), HasSubstr("did you mean 'slalom'?"));
    EXPECT_THAT(inputError([] { World("none/of.toml", "", with({}), 1); }), HasSubstr("no such file"));
    EXPECT_THAT(inputError([] { with({{"speed", "61"}}); }), HasSubstr("61"));
    const TestFolder folder;
    const auto pedals = folder.write("p.csv", "time_s,throttle,brake,steer\n0,0.2,0,0\n");
    EXPECT_THAT(inputError([&] {
                    World("plain", pedals.string(), with({{"speed", "10"}}), 1);
                }),
                HasSubstr("uses pedals"));
    const auto slow = folder.write("slow.toml", "description = \"slow\"\n[vehicle]\ntop_speed = 20\n");
    EXPECT_THAT(inputError([&] {
                    World(slow.string(), "", with({{"speed", "30"}}), 1);
                }),
                HasSubstr("top speed of 20"));
    const auto lost = folder.write("lost.toml", "description = \"lost\"\ndust = \"wheel_dast\"\n");
    EXPECT_THAT(inputError([&] { World(lost.string(), "", with({}), 1); }), HasSubstr("wheel_dust"));
}

TEST(World, DrivesByPedalsFromRest) {
    const TestFolder folder;
    const auto pedals = folder.write("p.csv", "time_s,throttle,brake,steer\n0,0,1,0\n1,0.5,0,0\n");
    World world("plain", pedals.string(), with({{"preroll", "1"}}), 1);
    run(world, world.prerollSteps());
    EXPECT_EQ(world.state().vehicle.speed, 0);
    run(world, 180);
    EXPECT_GT(world.state().vehicle.speed, 2);
}

}  // namespace
}  // namespace dustbench::world
