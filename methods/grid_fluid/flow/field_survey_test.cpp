// Compares the survey of a field with a plain loop over its values.
#include "methods/grid_fluid/flow/field_survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace dustbench::grid_fluid::flow {
namespace {

class RandomRecords {
 public:
    std::vector<float> of(std::size_t cells) {
        std::normal_distribution<float> value(0, 100);
        std::vector<float> records(cells * lanes);
        for (float& number : records) number = value(random_);
        return records;
    }
    std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }

 private:
    std::mt19937 random_{11};
};

TEST(FieldSurvey, FindsTheGreatestMagnitudesOfAllItsRows) {
    RandomRecords random;
    for (int round = 0; round < 200; ++round) {
        std::array<float, lanes> expected{};
        FieldSurvey all;
        for (int row = 0; row < 3; ++row) {
            const std::vector<float> records = random.of(1 + random.below(70));
            for (std::size_t f = 0; f < records.size(); ++f)
                expected[f % lanes] = std::max(expected[f % lanes], std::fabs(records[f]));
            FieldSurvey part;
            part.look(records.data(), records.size() / lanes);
            all.add(part);
        }
        EXPECT_TRUE(all.finite());
        EXPECT_EQ(all.maxima(), expected);
    }
}

TEST(FieldSurvey, SeesOneNumberThatIsNotFinite) {
    RandomRecords random;
    for (const float lost : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity()})
        for (int round = 0; round < 100; ++round) {
            std::vector<float> records = random.of(1 + random.below(70));
            records[random.below(records.size())] = lost;
            FieldSurvey part, all;
            part.look(records.data(), records.size() / lanes);
            all.add(part);
            EXPECT_FALSE(part.finite());
            EXPECT_FALSE(all.finite());
        }
}

TEST(FieldSurvey, ReadsNothingBeyondItsCells) {
    RandomRecords random;
    for (std::size_t cells = 0; cells < 40; ++cells) {
        std::vector<float> records = random.of(cells + 8);
        std::fill(records.begin() + static_cast<std::ptrdiff_t>(cells * lanes), records.end(),
                  std::numeric_limits<float>::quiet_NaN());
        FieldSurvey survey;
        survey.look(records.data(), cells);
        EXPECT_TRUE(survey.finite()) << cells;
    }
}

}  // namespace
}  // namespace dustbench::grid_fluid::flow
