// Exporting dust and reading it back gives the same dust.
#include <gtest/gtest.h>

#include "bench/export/exporter.h"
#include "bench/export/format_writers.h"
#include "bench/world/world.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::exports {
namespace {

ParameterValues shortPreroll(const std::string& particles) {
    ParameterValues values(world::worldParameters());
    values.set("preroll", "0.3");
    values.set("particles", particles);
    return values;
}

TEST(DustRoundTrip, GivesTheSameStateInEveryFrame) {
    constexpr int warmup = 3, frames = 9;
    const TestFolder folder;
    Series series(folder.path() / "particles.pvd", Series::Kind::pvd);
    world::World own("plain", "", shortPreroll("400"), 7);
    std::vector<std::uint64_t> hashes;
    for (std::int64_t step = own.prerollSteps() + warmup; step > 0; --step) own.step();
    for (int frame = 0; frame < frames; ++frame) {
        own.step();
        const std::string name = "f" + std::to_string(frame) + ".vtp";
        writeVtp(own.dust(), own.state().timeSeconds, folder.path() / name);
        series.add(name, own.state().timeSeconds);
        hashes.push_back(own.stateHash());
    }
    ASSERT_GT(own.dust().size(), 20u);

    world::World given("plain", "", shortPreroll("0"), 8);
    given.useDust({series.file().string(), "", warmup, frames});
    for (std::int64_t step = given.prerollSteps() + warmup; step > 0; --step) given.step();
    const std::size_t held = given.dust().size();
    given.step();
    EXPECT_EQ(given.dust().size(), held);
    for (int frame = 0; frame < frames; ++frame) {
        EXPECT_EQ(given.stateHash(), hashes[static_cast<std::size_t>(frame)]) << "frame " << frame;
        given.step();
    }
    EXPECT_EQ(given.inputFiles().size(), own.inputFiles().size() + 1 + frames);
}

TEST(DustRoundTrip, EndsWhereItsFilesEnd) {
    const TestFolder folder;
    Series series(folder.path() / "particles.pvd", Series::Kind::pvd);
    world::World own("plain", "", shortPreroll("400"), 7);
    for (int frame = 0; frame < 20; ++frame) own.step();
    for (const char* name : {"a.vtp", "b.vtp"}) {
        own.step();
        writeVtp(own.dust(), own.state().timeSeconds, folder.path() / name);
        series.add(name, own.state().timeSeconds);
    }
    const std::string file = series.file().string();
    world::World two("plain", "", shortPreroll("0"), 7), three("plain", "", shortPreroll("0"), 7),
        counted("plain", "", shortPreroll("5"), 7);
    EXPECT_NO_THROW(two.useDust({file, "", 0, 2}));
    EXPECT_NE(inputError([&] { three.useDust({file, "", 0, 3}); }).find("allowed: --frames 1..2"), std::string::npos);
    EXPECT_NE(inputError([&] {
                  counted.useDust({file, "", 0, 2});
              }).find("particles: got 5 with --dust"),
              std::string::npos);
}

}  // namespace
}  // namespace dustbench::exports
