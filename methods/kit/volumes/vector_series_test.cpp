#include "methods/kit/volumes/vector_series.h"

#include <gtest/gtest.h>

#include <random>

#include "methods/kit/files/matching_files.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::volumes {
namespace {

const std::vector<std::filesystem::path> gridNames{"a.vti", "b.vti", "c.vti"};

template <typename Field>
VectorGrid sampled(const glm::ivec3& cells, const glm::dvec3& origin, double spacing, double time, const Field& field) {
    VectorGrid grid{cells, origin, spacing, time, false, {}};
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x)
                grid.values.push_back(field(origin + spacing * (glm::dvec3(x, y, z) + 0.5)));
    return grid;
}

/// A field linear in position and time.
struct Linear {
    glm::dmat3 slope;
    glm::dvec3 constant, perSecond;
    glm::vec3 operator()(const glm::dvec3& p, double t) const { return constant + slope * p + perSecond * t; }
};

TEST(VectorSeries, ReproducesALinearFieldOfPlaceAndTimeExactly) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::mt19937_64 chance(seed);
        std::uniform_real_distribution<double> any(-1, 1), share(0, 1);
        Linear field;
        for (int c = 0; c < 3; ++c) {
            for (int r = 0; r < 3; ++r) field.slope[c][r] = any(chance);
            field.constant[c] = any(chance), field.perSecond[c] = any(chance);
        }
        const glm::ivec3 cells(7, 5, 9);
        const glm::dvec3 origin(100 * any(chance), any(chance), any(chance));
        const double spacing = 0.3;
        std::vector<VectorGrid> grids;
        for (const double time : {1.0, 1.5, 3.0})
            grids.push_back(sampled(cells, origin, spacing, time, [&](const glm::dvec3& p) { return field(p, time); }));
        const VectorSeries series(grids, gridNames);
        for (int i = 0; i < 500; ++i) {
            const double time = 1 + 2 * share(chance);
            const glm::dvec3 within(share(chance), share(chance), share(chance));
            const glm::dvec3 point = origin + spacing * (0.5 + within * (glm::dvec3(cells) - 1.0));
            const auto found = series.momentAt(time).at(point);
            ASSERT_TRUE(found);
            EXPECT_LT(glm::distance(*found, field(point, time)), 1e-4f) << "seed " << seed;  // values up to 100, floats
        }
    }
}

TEST(VectorSeries, HasNoVectorBeyondItsGridAndTheOutermostUpToItsFaces) {
    const auto along = [](const glm::dvec3& p) { return glm::vec3(p); };
    const VectorSeries series({sampled({4, 4, 4}, {-1, 0, 2}, 0.5, 0, along)}, gridNames);
    const VectorSeries::Moment moment = series.momentAt(0);
    EXPECT_FALSE(moment.at({-1.001, 1, 3}));
    EXPECT_FALSE(moment.at({0, 2.001, 3}));
    EXPECT_FALSE(moment.at({0, 1, 4.001}));
    EXPECT_FALSE(moment.at({NAN, 1, 3}));
    ASSERT_TRUE(moment.at({-0.999, 1, 3}));
    EXPECT_NEAR(moment.at({-0.999, 1, 3})->x, -0.75f, 1e-6f);
    EXPECT_NEAR(moment.at({0.999, 1, 3})->x, 0.75f, 1e-6f);
    const VectorSeries flat({sampled({1, 1, 1}, {0, 0, 0}, 1, 0, along)}, gridNames);
    EXPECT_NEAR(flat.momentAt(0).at({0.1, 0.9, 0.5})->x, 0.5f, 1e-6f);
}

TEST(VectorSeries, StandsStillBeforeItsFirstAndAfterItsLastTime) {
    std::vector<VectorGrid> grids;
    for (const double time : {2.0, 4.0})
        grids.push_back(sampled({2, 2, 2}, {0, 0, 0}, 1, time, [&](const glm::dvec3&) { return glm::vec3(time); }));
    const VectorSeries series(grids, gridNames);
    for (const auto& [time, expected] :
         std::vector<std::pair<double, float>>{{0, 2}, {2, 2}, {2.5, 2.5f}, {4, 4}, {9, 4}})
        EXPECT_NEAR(series.momentAt(time).at({1, 1, 1})->x, expected, 1e-6f) << time;
}

TEST(VectorSeries, OfSparseGridsReachesAsFarAsAnyOfThem) {
    const auto one = [](const glm::dvec3&) { return glm::vec3(1, 2, 3); };
    std::vector<VectorGrid> grids{sampled({2, 2, 2}, {0, 0, 0}, 0.5, 0, one),
                                  sampled({2, 3, 2}, {-1, 0.5, 0}, 0.5, 1, one)};
    for (VectorGrid& grid : grids) grid.sparse = true;
    const VectorSeries series(grids, gridNames);
    EXPECT_EQ(*series.momentAt(0).at({0.5, 0.5, 0.5}), glm::vec3(1, 2, 3));
    EXPECT_EQ(*series.momentAt(1).at({-0.5, 1.25, 0.5}), glm::vec3(1, 2, 3));
    EXPECT_EQ(*series.momentAt(0).at({-0.75, 1.25, 0.5}), glm::vec3(0));
    EXPECT_FALSE(series.momentAt(0).at({-1.1, 1, 0.5}));
}

TEST(VectorSeries, RefusesGridsThatDifferAndTimesThatDoNotGrow) {
    const auto none = [](const glm::dvec3&) { return glm::vec3(0); };
    const auto refused = [&](const glm::ivec3& cells, const glm::dvec3& origin, double spacing,
                             std::optional<double> time, bool sparse = false) {
        std::vector<VectorGrid> grids{sampled({2, 2, 2}, {0, 0, 0}, 1, 1, none),
                                      sampled(cells, origin, spacing, 0, none)};
        grids[1].timeSeconds = time;
        for (VectorGrid& grid : grids) grid.sparse = sparse;
        return inputError([&] { const VectorSeries series(grids, gridNames); });
    };
    EXPECT_NE(refused({2, 2, 3}, {0, 0, 0}, 1, 2).find("b.vti: is on a different grid"), std::string::npos);
    EXPECT_NE(refused({2, 2, 2}, {1, 0, 0}, 1, 2).find("is on a different grid"), std::string::npos);
    EXPECT_NE(refused({2, 2, 2}, {0, 0, 0}, 1.1, 2).find("is on a different grid"), std::string::npos);
    EXPECT_NE(refused({2, 2, 2}, {0.4, 0, 0}, 1, 2, true).find("is on a different grid"), std::string::npos);
    EXPECT_NE(refused({2, 2, 2}, {0, 0, 0}, 1, 1).find("expected more than 1 s"), std::string::npos);
    EXPECT_NE(refused({2, 2, 2}, {0, 0, 0}, 1, 0.5).find("expected more than 1 s"), std::string::npos);
    EXPECT_NE(refused({2, 2, 2}, {0, 0, 0}, 1, std::nullopt).find("no time"), std::string::npos);
    EXPECT_NE(inputError([] { const VectorSeries series(std::vector<VectorGrid>{}, gridNames); }), "");
}

TEST(VectorSeries, FindsFilesByAPattern) {
    const TestFolder folder;
    for (const char* name : {"f2.vti", "f1.vti", "g1.vti", "f1.vdb"}) folder.write(name, "");
    const auto found = files::matchingFiles(folder.path() / "f*.vti");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found.front().filename(), "f1.vti");
    EXPECT_NE(inputError([&] { (void)files::matchingFiles(folder.path() / "x*.vti"); }).find("no such file"),
              std::string::npos);
    EXPECT_NE(inputError([&] { (void)files::matchingFiles(folder.path() / "x.vti"); }).find("no such file"),
              std::string::npos);
}

}  // namespace
}  // namespace dustbench::volumes
