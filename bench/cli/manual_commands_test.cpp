// The manual page and the completions, tested with the programs that read them.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "bench/cli/called_program.h"

namespace dustbench::cli {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

class ManualCommands : public Dustbench {
 protected:
    /// The completions that bash offers for the last of these words, with the program on the path.
    [[nodiscard]] std::vector<std::string> completed(const std::string& words) const {
        std::ofstream(folder_ / "complete.sh")
            << "PATH=" << fs::path(DUSTBENCH_PROGRAM).parent_path().string() << ":$PATH\n"
            << "source <(dustbench completion bash)\nCOMP_WORDS=(" << words
            << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_dustbench\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
        const Called called = callAs("bash", fmt::format("--norc '{}'", (folder_ / "complete.sh").string()));
        EXPECT_EQ(called.err, "");
        return linesOf(called.out);
    }
    /// The ids that a list prints.
    [[nodiscard]] std::vector<std::string> ids(const std::string& kind) const {
        return linesOf(call("list " + kind + " --ids").out);
    }
};

/// In CI all tools are installed, so a missing one is an error.
bool isInstalled(const char* tool) {
    const bool isThere = std::system(fmt::format("command -v {} > /dev/null", tool).c_str()) == 0;
    EXPECT_TRUE(isThere || std::getenv("CI") == nullptr) << tool;
    return isThere;
}

TEST_F(ManualCommands, BashCompletesCommandsOptionsAndNames) {
    const auto commands = completed("dustbench ''");
    EXPECT_THAT(commands, IsSupersetOf({"run", "suite", "list", "completion", "manual", "--data", "--version"}));
    for (const ToolInfo& tool : tools()) EXPECT_THAT(commands, Contains(tool.id));
    EXPECT_THAT(completed("dustbench run --me"),
                testing::UnorderedElementsAre("--method", "--metrics", "--method-path"));
    EXPECT_THAT(completed("dustbench --data somewhere run --fra"), testing::ElementsAre("--frames"));
    EXPECT_EQ(completed("dustbench run --method ''"), ids("methods"));
    EXPECT_THAT(completed("dustbench run --scene ''"), IsSupersetOf(ids("scenes")));
    EXPECT_THAT(completed("dustbench report folder --format ''"), testing::ElementsAre("svg", "png", "pdf"));
    EXPECT_THAT(completed("dustbench completion z"), testing::ElementsAre("zsh"));
    EXPECT_THAT(completed("dustbench --data = somewhere report folder --format = p"),
                testing::ElementsAre("png", "pdf"));
    EXPECT_THAT(completed("dustbench report folder --format ="), testing::ElementsAre("svg", "png", "pdf"));
    EXPECT_THAT(completed("dustbench list me"), testing::ElementsAre("methods", "metrics"));
    EXPECT_EQ(completed("dustbench nowhere ''"), std::vector<std::string>{""});
}

TEST_F(ManualCommands, EveryOptionIsInThePageAndTheScripts) {
    const std::string page = call("manual").out;
    std::vector<std::string> texts;
    for (const char* shell : {"bash", "zsh", "fish"}) texts.push_back(call(fmt::format("completion {}", shell)).out);
    for (const char* command : {"run", "suite", "compare", "reproduce", "report", "view", "diff", "export", "merge"}) {
        EXPECT_THAT(page, HasSubstr(fmt::format(".SH {}\n", command)));
        for (const std::string& line : linesOf(call(fmt::format("{} --help", command)).out)) {
            const std::size_t from = line.find("--");
            if (from == std::string::npos || line.find_first_not_of(' ') + 4 < from) continue;  // `-h,--help` at most
            const std::string name =
                line.substr(from + 2, line.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", from) - from - 2);
            for (const std::string& text : texts) EXPECT_THAT(text, HasSubstr(name)) << command;
            std::string inRoff = name;
            for (std::size_t at = 0; (at = inRoff.find('-', at)) != std::string::npos; at += 2) inRoff.insert(at, "\\");
            EXPECT_THAT(page, HasSubstr("\\fB\\-\\-" + inRoff)) << command;
        }
    }
}

TEST_F(ManualCommands, ThePageHasNoFaultsOfRoff) {
    if (!isInstalled("groff")) GTEST_SKIP() << "groff is not installed (.ci/install package)";
    std::ofstream(folder_ / "dustbench.1") << call("manual").out;
    const Called called =
        callAs("groff", fmt::format("-man -ww -Tutf8 -P-cbu '{}'", (folder_ / "dustbench.1").string()));
    EXPECT_EQ(called.code, 0);
    EXPECT_EQ(called.err, "");
    EXPECT_THAT(called.out, HasSubstr("--frames"));
}

TEST_F(ManualCommands, TheShellsReadTheirScripts) {
    std::string missing;
    for (const char* shell : {"bash", "zsh", "fish"}) {
        if (!isInstalled(shell)) {
            missing += fmt::format(" {}", shell);
            continue;
        }
        std::ofstream(folder_ / "script") << call(fmt::format("completion {}", shell)).out;
        const Called called = callAs(shell, fmt::format("-n '{}'", (folder_ / "script").string()));
        EXPECT_EQ(called.code, 0) << shell << called.err;
    }
    const Called unknown = call("completion tcsh");
    EXPECT_EQ(unknown.code, 3);
    EXPECT_THAT(unknown.err, HasSubstr("tcsh"));
    if (!missing.empty()) GTEST_SKIP() << "not installed (.ci/install package):" << missing;
}

TEST_F(ManualCommands, IdsAreOneALine) {
    EXPECT_THAT(ids("methods"), Contains(methods().front().id));
    EXPECT_THAT(ids("parts"), Not(IsEmpty()));
    EXPECT_EQ(call("list methods --ids --json").code, 3);
}

}  // namespace
}  // namespace dustbench::cli
