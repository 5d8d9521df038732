#include "bench/suite/paper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "bench/results/temporary_folder.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"

namespace dustbench::suite {

TEST(Paper, EveryPaperOfTheProjectNamesSuitesThatExist) {
    EXPECT_THAT(listPapers(), testing::Contains("carr2006"));
    for (const std::string& id : listPapers()) {
        const Paper paper = loadPaper(id);
        EXPECT_FALSE(paper.suites.empty()) << id;
        for (const std::string& suite : paper.suites) EXPECT_NO_THROW((void)loadSuite(suite, true)) << suite;
    }
}

TEST(Paper, AnUnknownPaperHasANearestName) {
    try {
        (void)loadPaper("carr206");
        FAIL() << "nothing thrown";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("'carr2006'"));
    }
}

TEST(Paper, AnUnknownExperimentIsAnErrorBeforeAnythingIsMeasured) {
    const results::TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "papers/mud");
    std::ofstream(folder.path() / "papers/mud/paper.toml")
        << "id = \"mud\"\ntitle = \"\"\nauthors = \"\"\nvenue = \"\"\nkey = \"\"\nsummary = \"\"\n"
           "suites = []\nexperiments = [\"sampling\", \"samplin\"]\n";
    const char* before = std::getenv("DUSTBENCH_DATA");
    const std::string old = before ? before : "";
    setenv("DUSTBENCH_DATA", folder.path().c_str(), 1);
    std::string fault;
    try {
        (void)loadPaper("mud");
    } catch (const InputError& error) {
        fault = error.what();
    }
    before ? setenv("DUSTBENCH_DATA", old.c_str(), 1) : unsetenv("DUSTBENCH_DATA");
    EXPECT_THAT(fault, testing::HasSubstr("paper.toml:8: unknown experiment 'samplin' (did you mean 'sampling'?)"));
}

}  // namespace dustbench::suite
