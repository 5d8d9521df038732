#include "bench/suite/paper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/suite/made_paper.h"
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
    const MadePaper paper("suites = []\nexperiments = [\"sampling\", \"samplin\"]\n");
    try {
        (void)loadPaper("mud");
        FAIL() << "nothing thrown";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(),
                    testing::HasSubstr("paper.toml:8: unknown experiment 'samplin' (did you mean 'sampling'?)"));
    }
}

}  // namespace dustbench::suite
