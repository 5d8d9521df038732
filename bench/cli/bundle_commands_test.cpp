#include <gmock/gmock.h>

#include "bench/cli/called_program.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

class BundleCommands : public Dustbench {
 protected:
    void SetUp() override {
        Dustbench::SetUp();
        fs::create_directories(folder_ / "mine/scenes");
        fs::copy(files::dataFolder() / "scenes/plain.toml", folder_ / "mine/scenes/mine.toml");
    }
    [[nodiscard]] std::string mine() const { return fmt::format("--data '{}'", (folder_ / "mine").string()); }
    [[nodiscard]] std::string bundle() const { return (folder_ / "b.tar").string(); }
    /// A suite of two repetitions with a user's scene.
    void measure() const {
        std::ofstream(folder_ / "small.toml") << "title = \"Small\"\nmethods = [\"null_method\"]\nscenes = "
                                                 "[\"mine\"]\nframes = 3\nwarmup = 1\nrepetitions = 2\n"
                                                 "sizes = [\"64x48\"]\n[parameters]\nparticles = 50\npreroll = 0.2\n";
        const Called called =
            call(fmt::format("suite '{}' {} --out '{}'", (folder_ / "small.toml").string(), mine(), out()));
        ASSERT_EQ(called.code, 0) << called.err;
    }
    [[nodiscard]] Called pack() const {
        return call(fmt::format("bundle '{}' {} --out '{}'", out(), mine(), bundle()));
    }
    [[nodiscard]] Called verify(const std::string& more = "") const {
        return call(fmt::format("verify '{}' {}", bundle(), more));
    }
    /// Unpacks the bundle, lets shell commands change it, and packs it again with recomputed checksums.
    void forge(const std::string& commands) const {
        const Called called = callAs(
            "bash", fmt::format("-ec 'cd \"{}\" && rm -rf b && tar -xf b.tar && cd b && {} && rm SHA256SUMS && "
                                "find * -type f | xargs sha256sum > ../sums && mv ../sums SHA256SUMS && cd .. && "
                                "tar --format=ustar -cf b.tar $(find b -type f)'",
                                folder_.string(), commands));
        ASSERT_EQ(called.code, 0) << called.err;
    }
};

TEST_F(BundleCommands, ABundleAloneIsEnoughToRepeatItsRuns) {
    measure();
    const Called packed = pack();
    EXPECT_EQ(packed.code, 0) << packed.err;
    EXPECT_EQ(packed.out, bundle() + "\n");
    for (const char* name : {"mine", "small.toml", "out"}) fs::remove_all(folder_ / name);
    const Called verified = verify();
    EXPECT_EQ(verified.code, 0) << verified.err;
    EXPECT_THAT(verified.out, HasSubstr("files are unchanged: 2 runs of 1 simulations"));
    EXPECT_THAT(verified.out, HasSubstr("and 1 more: the same hashes"));
    EXPECT_THAT(verify("--runs 0").out, Not(HasSubstr("hashes")));
    const Called listed = callAs("tar", fmt::format("-tf '{}'", bundle()));
    for (const char* name :
         {"b/inputs/scenes/mine.toml", "b/suites/small.toml", "b/results/summary.csv", "b/bundle.json"})
        EXPECT_THAT(listed.out, HasSubstr(std::string(name) + "\n"));
    const Called summed = callAs(
        "bash", fmt::format("-ec 'cd \"{}\" && tar -xf b.tar && cd b && sha256sum -c SHA256SUMS'", folder_.string()));
    EXPECT_EQ(summed.code, 0) << summed.err << summed.out;
}

TEST_F(BundleCommands, TheSuitesOfAPaperAreInItsBundle) {
    fs::create_directories(folder_ / "mine/papers");
    measure();
    const fs::path run = runs(out()).front() / "run.json";
    std::string text = contentOf(run);
    text.replace(text.find("\"suite\""), 7, "\"reproduce\"");
    text.replace(text.find("small.toml\""), 11, "\", \"--paper=carr2006\"");
    std::ofstream(run) << text;
    ASSERT_EQ(pack().code, 0);
    const Called listed = callAs("tar", fmt::format("-tf '{}'", bundle()));
    for (const char* name : {"small.toml", "carr2006-compare.toml", "carr2006-fig5.toml"})
        EXPECT_THAT(listed.out, HasSubstr(fmt::format("b/suites/{}\n", name)));
    EXPECT_THAT(listed.out, Not(HasSubstr("bergeron")));
    fs::remove(folder_ / "small.toml");
    fs::remove(bundle());
    const Called without = pack();
    EXPECT_EQ(without.code, 0);
    EXPECT_THAT(without.err, HasSubstr("small.toml"));
    EXPECT_THAT(without.err, HasSubstr("no longer exists"));
}

TEST_F(BundleCommands, EveryAlteredByteIsNoticed) {
    measure();
    ASSERT_EQ(pack().code, 0);
    const std::string whole = contentOf(bundle());
    for (std::size_t part = 0; part < 10; ++part) {
        std::string altered = whole;
        // Of a file's bytes: padding is zero, and no file is.
        std::size_t at = part * whole.size() / 10;
        while (altered[at] == '\0') ++at;
        altered[at] = altered[at] == 'x' ? 'y' : 'x';
        std::ofstream(bundle(), std::ios::binary) << altered;
        const Called verified = verify("--runs 0");
        EXPECT_EQ(verified.code, 3) << at;
        EXPECT_EQ(std::count(verified.err.begin(), verified.err.end(), '\n'), 1) << verified.err;
    }
}

TEST_F(BundleCommands, ForgedHashesAreNoticedByRunningAgain) {
    measure();
    ASSERT_EQ(pack().code, 0);
    forge(
        "sed -i \"s/\\\"state_hash\\\": \\\"[0-9a-f]*\\\"/\\\"state_hash\\\": \\\"0123456789abcdef\\\"/\" "
        "results/runs/*/run.json");
    EXPECT_EQ(verify("--runs 0").code, 0);
    const Called verified = verify();
    EXPECT_EQ(verified.code, 1) << verified.err;
    EXPECT_THAT(verified.out, HasSubstr("expected 0123456789abcdef"));
}

TEST_F(BundleCommands, WhatDoesNotBelongTogetherIsRefused) {
    measure();
    ASSERT_EQ(pack().code, 0);
    forge("true");
    EXPECT_EQ(verify("--runs 0").code, 0) << "the forger himself changes nothing";
    const std::string whole = contentOf(bundle());
    const auto refusedAfter = [&](const std::string& commands) {
        std::ofstream(bundle(), std::ios::binary) << whole;
        forge(commands);
        const Called verified = verify("--runs 0");
        EXPECT_EQ(verified.code, 3);
        return verified.err;
    };
    EXPECT_THAT(refusedAfter("echo >> inputs/scenes/mine.toml"), HasSubstr("that the runs read"));
    EXPECT_THAT(refusedAfter("rm inputs/scenes/mine.toml"), HasSubstr("that the runs read"));
    EXPECT_THAT(refusedAfter("echo >> $(ls results/runs/*/frames.csv | head -n 1)"), HasSubstr("frames.csv has"));
    EXPECT_THAT(refusedAfter("sed -i \"s/\\\"state_hash\\\": \\\"./\\\"state_hash\\\": \\\"x/\" "
                             "$(ls results/runs/*/run.json | head -n 1)"),
                HasSubstr("of the same simulation"));
    EXPECT_THAT(refusedAfter("rm -r results"), HasSubstr("not a results folder"));
    // Changes only the archive, not its checksums.
    const auto refusedAs = [&](const std::string& tarOptions) {
        std::ofstream(bundle(), std::ios::binary) << whole;
        const Called changed = callAs("tar", fmt::format("-C '{}' -f '{}' {}", folder_.string(), bundle(), tarOptions));
        EXPECT_EQ(changed.code, 0) << changed.err;
        return verify("--runs 0").err;
    };
    fs::create_directories(folder_ / "b");
    std::ofstream(folder_ / "b/more.txt") << "more\n";
    EXPECT_THAT(refusedAs("--format=ustar -r b/more.txt"), HasSubstr("'more.txt': is in the bundle but not listed in"));
    EXPECT_THAT(refusedAs("--delete b/bundle.json"), HasSubstr("'bundle.json': is missing from the bundle"));
}

TEST_F(BundleCommands, WhatIsNotAsItWasMeasuredIsNotPacked) {
    measure();
    std::ofstream(folder_ / "mine/scenes/mine.toml", std::ios::app) << "\n";
    const Called changed = pack();
    EXPECT_EQ(changed.code, 3);
    EXPECT_THAT(changed.err, HasSubstr("mine.toml': has changed since the runs read it"));
    EXPECT_FALSE(fs::exists(bundle()));
    fs::remove(folder_ / "mine/scenes/mine.toml");
    EXPECT_THAT(pack().err, HasSubstr("no longer exists"));
    fs::copy(files::dataFolder() / "scenes/plain.toml", folder_ / "mine/scenes/mine.toml");
    std::ofstream(runs(out()).front() / "frames.csv", std::ios::app) << "1\n";
    EXPECT_THAT(pack().err, HasSubstr("frames.csv has"));
}

TEST_F(BundleCommands, WrongUseIsOneLine) {
    std::ofstream(bundle()) << "no archive\n";
    EXPECT_THAT(verify().err, HasSubstr("not a dustbench bundle"));
    EXPECT_EQ(verify().code, 3);
    EXPECT_THAT(call("verify /nowhere.tar").err, HasSubstr("No such file"));
    EXPECT_THAT(pack().err, HasSubstr("already exists"));
    fs::remove(bundle());
    EXPECT_THAT(call(fmt::format("bundle '{}'", folder_.string())).err, HasSubstr("is not a results folder"));
    EXPECT_THAT(call(fmt::format("verify '{}'", folder_.string())).err, HasSubstr("dustbench: '"));
}

}  // namespace
}  // namespace dustbench::cli
