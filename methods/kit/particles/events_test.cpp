// Tests events: every one is reported once, where it happened, and does what its part says, with any number of threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <set>

#include "methods/contract/errors.h"
#include "methods/kit/particles/event_script.h"
#include "methods/kit/particles/test_world.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::particles {
namespace {

using testing::HasSubstr;

/// The systems of a file, with their events.
class Play {
 public:
    explicit Play(const std::string& toml, std::uint64_t seed = 1) {
        for (NamedParts& each : systemsFromText(toml, "play.toml"))
            systems_.emplace_back(each.name, std::make_unique<ParticleSystem>(std::move(each.parts), seed++));
    }
    void step(int steps, double seconds = 1.0 / 64) {
        const scene::Scene scene;
        const scene::SceneState state;
        for (int i = 0; i < steps; ++i) {
            std::vector<ScriptedSystem> scripted;
            scripted.reserve(systems_.size());
            for (auto& [name, system] : systems_) scripted.push_back({name, *system});
            applyEvents(scripted);
            for (auto& [name, system] : systems_) system->update({scene, state, seconds});
        }
    }
    [[nodiscard]] ParticleSystem& operator[](std::size_t i) { return *systems_[i].second; }
    [[nodiscard]] std::uint64_t born(std::size_t i) {
        std::uint64_t most = 0;  // of systems without deaths
        for (const std::uint64_t serial : systems_[i].second->store().serial) most = std::max(most, serial + 1);
        return most;
    }

 private:
    std::vector<std::pair<std::string, std::unique_ptr<ParticleSystem>>> systems_;
};

std::string systemNamed(const std::string& name, const std::string& parts) {
    return "[[system]]\nname = \"" + name + "\"\n" + parts +
           "colour = { part = \"constant\" }\nsize = { part = \"constant\", radius_metres = 0 }\n";
}

const std::string forEver = "life = [ { part = \"lifetime\", average_seconds = 1e5, variation_seconds = 0 } ]\n";
const std::string atRest = "velocity = { part = \"fixed\", speed = 0 }\n";

/// Particles that events start, and which stay where they were born.
std::string started(const std::string& name, const std::string& velocity = atRest) {
    return systemNamed(name, "emission = { part = \"on_event\" }\nposition = { part = \"point\", at = \"place\" }\n" +
                                 velocity + forEver);
}

/// `count` particles of a ball at 3 m, which fly down.
std::string flying(int count, double perSecond, const std::string& rest) {
    const std::string emission =
        perSecond > 0
            ? "part = \"stream\", rate_per_metre = 0, rate_per_second = " + std::to_string(perSecond)
            : "part = \"bursts\", duration_seconds = 0, interval_seconds = 1e6, count = " + std::to_string(count);
    return systemNamed("drops",
                       "emission = { " + emission +
                           " }\nposition = { part = \"sphere\", at = \"place\", place = [0, 3, 0], radius_metres = "
                           "1 }\nvelocity = { part = \"cone\", direction = [0, -1, 0], half_angle_degrees = 20, "
                           "speed = 30, variation = 0.4 }\n" +
                           rest);
}

TEST(Events, EveryDeathAtASurfaceStartsItsParticlesThere) {
    const int count = 5000;
    Play play(flying(count, 0,
                     "life = [ { part = \"lifetime\", average_seconds = 1e5, variation_seconds = 0 }, "
                     "{ part = \"collision\" } ]\n"
                     "event = [ { part = \"death\", starts = \"steam\", count = 3 } ]\n") +
              started("steam"));
    play.step(64);
    EXPECT_EQ(play[0].store().size(), 0u);
    ASSERT_EQ(play[1].store().size(), 3u * count);
    std::set<std::array<float, 3>> places;
    for (std::size_t i = 0; i < play[1].store().size(); ++i) {
        const glm::vec3 p = play[1].store().position(i);
        EXPECT_NEAR(p.y, 0, 1e-3);
        places.insert({p.x, p.y, p.z});
    }
    EXPECT_GE(places.size(), count * 0.99);
}

TEST(Events, EveryCollisionIsReportedOnceWithPlaceVelocityAndNormal) {
    // Bounces between two planes, 2 m apart, at 3 m/s: a contact each 2/3 s, the first after 1/3 s.
    Play play(
        systemNamed("ball",
                    "emission = { part = \"bursts\", duration_seconds = 0, interval_seconds = 1e6, count = 700 }\n"
                    "position = { part = \"point\", at = \"place\", place = [0, 1, 0] }\n"
                    "velocity = { part = \"fixed\", direction = [0, 1, 0], speed = 3 }\n" +
                        forEver +
                        "force = [ { part = \"bounce\", restitution = 1 }, { part = \"bounce\", restitution = 1, place "
                        "= [0, 2, 0], normal = [0, -1, 0] } ]\nevent = [ { part = \"collision\" }, "
                        "{ part = \"collision\", surface = 2 }, { part = \"collision\", minimum_speed = 3.1 } ]\n"));
    std::size_t all = 0, upper = 0, fast = 0;
    for (int i = 0; i < 640; ++i) {
        play.step(1);
        const auto events = play[0].events();
        all += events[0].size(), upper += events[1].size(), fast += events[2].size();
        for (const Event& event : events[0]) {
            EXPECT_NEAR(event.place.y, event.up.y < 0 ? 2 : 0, 1e-3);
            EXPECT_NEAR(event.velocity.y, -3 * event.up.y, 1e-5);
        }
    }
    EXPECT_EQ(all, 700u * 15);  // in 10 s
    EXPECT_EQ(upper, 700u * 8);
    EXPECT_EQ(fast, 0u);
}

TEST(Events, EveryEntryIntoARegionIsReportedOnceEvenInTheStepOfBirth) {
    // All fly through a wide disc at y = 2.5, which cuts the ball of births; those born below it never pass it.
    Play play(flying(0, 4000,
                     "life = [ { part = \"lifetime\", average_seconds = 9, variation_seconds = 0 } ]\n"
                     "event = [ { part = \"region\", shape = \"disc\", place = [0, 2.5, 0], radius_metres = "
                     "100 }, { part = \"region\", place = [0, 2.5, 0] }, { part = \"birth\" }, "
                     "{ part = \"region\", shape = \"sphere\", place = [0, -50, 0], radius_metres = 30 } ]\n"));
    std::set<std::uint64_t> passed;
    std::size_t discs = 0, spaces = 0, births = 0;
    for (int i = 0; i < 32; ++i) {
        play.step(1);
        for (const Event& event : play[0].events()[0]) {
            EXPECT_TRUE(passed.insert(event.serial).second);
            EXPECT_NEAR(event.place.y, 2.5, 1e-5);
        }
        discs += play[0].events()[0].size(), spaces += play[0].events()[1].size();
        births += play[0].events()[2].size();
    }
    const ParticleStore& s = play[0].store();
    EXPECT_EQ(births, s.size());
    std::size_t due = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const double bornAt = static_cast<double>(s.y[i] - s.age[i] * s.velocityY[i]);
        if (std::abs(bornAt - 2.5) < 1e-4) continue;  // rounding
        const bool passes = bornAt > 2.5 && s.y[i] < 2.5f;
        due += passes ? 1 : 0;
        EXPECT_EQ(passed.contains(s.serial[i]), passes) << bornAt << ' ' << s.y[i];
    }
    EXPECT_NEAR(static_cast<double>(discs), static_cast<double>(due), 3);
    EXPECT_EQ(discs, spaces);
    EXPECT_GT(due, 1000u);
}

TEST(Events, TimersRingAtTheirTimesWhateverTheStep) {
    for (const double seconds : {1.0 / 60, 1.0 / 7, 0.9}) {
        Play play(
            systemNamed("clock",
                        "emission = { part = \"on_event\" }\nposition = { part = \"point\", at = \"place\", place = "
                        "[0, 9, 0] }\n" +
                            atRest + forEver +
                            "event = [ { part = \"timer\", first_seconds = 0.5, interval_seconds = 0.25, place = [1, "
                            "2, 3], starts = \"clock\", count = 2 }, { part = \"timer\", first_seconds = 2, starts = "
                            "\"clock\", at = \"source\" } ]\n"));
        const int steps = static_cast<int>(std::ceil(9.1 / seconds));
        play.step(steps + 1, seconds);
        // Events up to the end of the last step but one: they act one step later.
        std::size_t rung = 0;
        for (double t = 0.5; t < steps * seconds; t += 0.25) ++rung;
        EXPECT_EQ(play[0].store().size(), 2 * rung + 1) << seconds;
        std::size_t atSource = 0;
        for (const float y : play[0].store().y) atSource += y == 9 ? 1 : 0;
        EXPECT_EQ(atSource, 1u);
    }
}

TEST(Events, NewbornsHaveTheShareOfTheVelocityAndTheSurfaceAsTheirGround) {
    // Up to a ceiling that is inclined by 45°: the cone's axis is its normal.
    Play play(
        systemNamed("rockets",
                    "emission = { part = \"bursts\", duration_seconds = 0, interval_seconds = 1e6, count = 1 }\n"
                    "position = { part = \"point\", at = \"place\" }\n"
                    "velocity = { part = \"fixed\", direction = [0, 1, 0], speed = 8 }\n" +
                        forEver +
                        "force = [ { part = \"bounce\", shape = \"half_space\", place = [0, 2, 0], normal = [-1, -1, "
                        "0] } ]\nevent = [ { part = \"collision\", starts = \"sparks\", inherit = 0.25 } ]\n") +
        started("sparks", "velocity = { part = \"cone\", half_angle_degrees = 0, speed = 4, variation = 0 }\n"));
    play.step(32);
    const ParticleStore& s = play[1].store();
    ASSERT_EQ(s.size(), 1u);
    EXPECT_NEAR(s.velocityX[0], -4 * std::sqrt(0.5), 1e-5);
    EXPECT_NEAR(s.velocityY[0], -4 * std::sqrt(0.5) + 2, 1e-5);
    const float age = s.age[0];
    EXPECT_NEAR(s.y[0] - age * s.velocityY[0], 2, 1e-4);
    EXPECT_NEAR(s.x[0] - age * s.velocityX[0], 0, 1e-4);
}

TEST(Events, StopResumeChangeAndRespectTheirLimits) {
    const std::string source =
        "emission = { part = \"stream\", rate_per_metre = 0, rate_per_second = 64 }\n"
        "position = { part = \"point\", at = \"place\" }\n" +
        atRest + forEver;
    Play play(systemNamed("stream",
                          source + "event = [ { part = \"timer\", first_seconds = 1, stops = \"stream\" }, "
                                   "{ part = \"timer\", first_seconds = 2, resumes = \"stream\" }, "
                                   "{ part = \"timer\", first_seconds = 3, changes = \"stream.emission.rate_per_second"
                                   "\", to = \"128\" }, "
                                   "{ part = \"birth\", starts = \"few\", limit = 10 }, "
                                   "{ part = \"birth\", starts = \"some\", share = 0.25 }, "
                                   "{ part = \"timer\", first_seconds = 3.5, place = [7, 8, 9], changes = "
                                   "\"some.position.place\", to = \"place\" } ]\n") +
              started("few") + started("some"));
    play.step(64);
    EXPECT_NEAR(static_cast<double>(play.born(0)), 64, 1);
    play.step(64);
    EXPECT_NEAR(static_cast<double>(play.born(0)), 65, 1);
    play.step(64);
    EXPECT_NEAR(static_cast<double>(play.born(0)), 128, 2);
    play.step(64);
    EXPECT_NEAR(static_cast<double>(play.born(0)), 256, 3);
    EXPECT_EQ(play[1].store().size(), 10u);
    EXPECT_NEAR(static_cast<double>(play[2].store().size()), 64, 4 * std::sqrt(256 * 0.25 * 0.75));
    EXPECT_EQ(play[2].parts().position()->values().real("place.y"), 8);
}

TEST(Events, AreTheSameBitForBitAtAnyNumberOfThreads) {
    const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
    std::set<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3, 8}) {
        Play play(flying(0, 60'000,
                         "life = [ { part = \"lifetime\", average_seconds = 0.2, variation_seconds = 0.1 } ]\n"
                         "force = [ { part = \"bounce\", friction = 0.5 } ]\n"
                         "event = [ { part = \"collision\", starts = \"splash\", count = 2, share = 0.7, inherit = 0.1 "
                         "}, { part = \"death\", starts = \"steam\", share = 0.5 }, { part = \"region\", place = [0, "
                         "1, 0], starts = \"steam\" } ]\n") +
                  systemNamed("splash",
                              "emission = { part = \"on_event\" }\nposition = { part = \"sphere\", at = "
                              "\"place\", radius_metres = 0.1 }\nvelocity = { part = \"random\" }\nlife = [ { part "
                              "= \"lifetime\", average_seconds = 0.1, variation_seconds = 0.05 } ]\n"
                              "event = [ { part = \"death\", starts = \"steam\" } ]\n") +
                  started("steam", "velocity = { part = \"random\" }\n"));
        tbb::task_arena(threads).execute([&] { play.step(60); });
        EXPECT_GT(play[1].store().size(), 1000u);
        EXPECT_GT(play[2].store().size(), 20'000u);
        hashes.insert(play[0].stateHash() ^ play[1].stateHash() * 3 ^ play[2].stateHash() * 5);
    }
    EXPECT_EQ(hashes.size(), 1u);
}

TEST(Events, NameSystemsAndChangesThatExist) {
    const auto messageOf = [](const std::string& event) {
        try {
            auto systems = systemsFromText(
                flying(1, 0, forEver + "event = [ { part = \"death\", " + event + " } ]\n") + started("steam"),
                "x.toml");
            std::vector<NamedPartsView> views;
            views.reserve(systems.size());
            for (const NamedParts& each : systems) views.push_back({each.name, *each.parts});
            requireScript(views);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(messageOf("starts = \"steam\""), "");
    EXPECT_EQ(messageOf("changes = \"steam.size.part\", to = \"random\""), "");
    EXPECT_THAT(messageOf("starts = \"stem\""), HasSubstr("event death of system drops"));
    EXPECT_THAT(messageOf("stops = \"stem\""), HasSubstr("'stem'"));
    EXPECT_THAT(messageOf("changes = \"steam.size.radius\", to = \"1\""), HasSubstr("radius_metres"));
    EXPECT_THAT(messageOf("changes = \"steam.size.radius_metres\""), HasSubstr("changes and to together"));
    const TestFolder folder;
    const auto file = folder.write("dust.toml", "event = [ { part = \"birth\" } ]\n" + test::everyForce);
    EXPECT_THROW((void)partsFromFile(file), InputError);
}

}  // namespace
}  // namespace dustbench::particles
