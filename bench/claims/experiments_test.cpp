#include "bench/claims/experiments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::claims {
namespace {

TEST(Experiments, AreFoundInTheirFoldersWithWhatTheyAreFor) {
    ASSERT_FALSE(experiments().empty());
    for (const ExperimentInfo& info : experiments()) {
        EXPECT_FALSE(info.summary.empty()) << info.id;
        EXPECT_FALSE(info.source.empty()) << info.id;
        EXPECT_FALSE(info.folder.empty()) << info.id;
    }
    EXPECT_EQ(findExperiment("sampling").folder, "kit/particles");
}

TEST(Findings, AreReadAsTheyWereWritten) {
    const TestFolder folder;
    EXPECT_TRUE(readFindings(folder.path()).empty());
    const double none = std::nan("");
    const std::vector<StoredFinding> written{{{"acceptance", 0.5236, 0.52, 0.53, 1000}, "sampling"},
                                             {{"seconds", none, none, none, 0, "skipped: 1, 2"}, "ageing"}};
    folder.write("experiments.csv", findingsCsv(written));
    const std::vector<StoredFinding> read = readFindings(folder.path());
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].experiment, "sampling");
    EXPECT_EQ(read[0].quantity, "acceptance");
    EXPECT_EQ(read[0].value, 0.5236);
    EXPECT_EQ(read[0].samples, 1000);
    EXPECT_EQ(read[0].note, "");
    EXPECT_TRUE(std::isnan(read[1].value) && std::isnan(read[1].low) && std::isnan(read[1].high));
    EXPECT_EQ(read[1].note, "skipped: 1, 2");
    folder.write("experiments.csv", "experiment,quantity,value,low,high,samples\nsampling,acceptance,1,1,1,1\n");
    EXPECT_EQ(readFindings(folder.path()).at(0).note, "");  // older results have no notes
    EXPECT_THROW((void)runExperiment("smapling"), InputError);
}

}  // namespace
}  // namespace dustbench::claims
