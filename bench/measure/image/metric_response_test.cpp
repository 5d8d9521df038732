// Each metric responds to the flaw that it measures and ignores others, as stated in the table in reports/METRICS.md.
// The test keeps table and code consistent.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "bench/measure/image/flaw_metrics.h"
#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture_error.h"
#include "bench/measure/image/test_splatter.h"
#include "source_folder.h"

namespace dustbench::measure {
namespace {

using Puffs = std::vector<TestPuff>;
using Scores = std::map<std::string, std::optional<double>>;

constexpr int frames = 31;
constexpr double speedPixels = 0.7;  // per frame

/// A trail of puffs `spacing` apart that runs to the right, each up to `scatter` off its line and `jitter` spacings
/// along it. With `parts` 64 it is the continuum: each puff is replaced by 64 evenly spread ones with a 64th of its
/// depth.
struct Trail {
    int puffs = 50;
    double spacing = 7, scatter = 20, jitter = 0.5, depthRange = 0;

    [[nodiscard]] Puffs at(int frame, double middle, int parts = 1) const {
        Puffs list;
        for (int i = 0; i < puffs * parts; ++i) {
            const auto [along, across] = testUniform(parts == 1 ? 1 : 2, static_cast<std::uint64_t>(i));
            const auto [away, unused] = testUniform(parts == 1 ? 3 : 4, static_cast<std::uint64_t>(i));
            TestPuff puff;
            const double place = (i + 0.5) / parts + jitter * (2 * along - 1) / parts;
            puff.x = 30 + spacing * place + speedPixels * frame;
            puff.y = middle + scatter * (2 * across - 1);
            puff.depth = depthRange * (2 * away - 1);
            puff.tau /= parts;
            list.push_back(puff);
        }
        return list;
    }
};

/// How a method draws a frame's puffs at each level of a flaw. Level 0 has no flaw, except for `textures`.
struct Flaw {
    std::string name;
    int levels;
    Trail (*trail)(int level);
    Puffs (*drawn)(int level, Puffs puffs);
    double (*softness)(int level);
    bool ground;
};

Trail dense(int) {
    return {100, 3.5, 20, 0.5, 0};
}
Trail loose(int) {
    return {50, 10, 35, 0.5, 0};
}
Puffs asTheyAre(int, Puffs puffs) {
    return puffs;
}
double exact(int) {
    return 1;
}

/// Snaps puffs to the centres of larger and larger cells, as voxels are.
Puffs snapped(int level, Puffs puffs) {
    const double edge = 2.0 * level;
    if (level > 0)
        for (TestPuff& puff : puffs) {
            puff.x = (std::floor(puff.x / edge) + 0.5) * edge;
            puff.y = (std::floor(puff.y / edge) + 0.5) * edge;
        }
    return puffs;
}

/// The same number of puffs along a longer and longer trail.
Trail strung(int level) {
    return {16, 10.0 + 9 * level, 1, 0.4, 0};
}

Trail deep(int) {
    return {100, 3.5, 20, 0.5, 15};
}
double hardness(int level) {
    return std::array{1.0, 0.6, 0.3, 0.1, 0.0}[static_cast<std::size_t>(level)];
}

/// Puffs of the same opacity, wider and wider.
Puffs spread(int level, Puffs puffs) {
    for (TestPuff& puff : puffs) puff.radius *= 1 + 0.5 * level;
    return puffs;
}

/// All different, 16, 4 or 1 textures; each cloud has its own textures and random choices.
Puffs texturedAs(int cloud, int level, Puffs puffs) {
    const int textures = std::array{0, 16, 4, 1}[static_cast<std::size_t>(level)];
    for (std::size_t i = 0; i < puffs.size(); ++i) {
        const double lot = testUniform(9, i + 1000 * static_cast<std::size_t>(cloud))[0];
        puffs[i].texture = 1000 * cloud + (textures == 0 ? static_cast<int>(i) : static_cast<int>(lot * textures));
    }
    return puffs;
}
Puffs textured(int level, Puffs puffs) {
    return texturedAs(0, level, std::move(puffs));
}

const std::vector<Flaw>& flaws() {
    static const std::vector<Flaw> list{{"snapped", 5, dense, snapped, exact, false},
                                        {"strung", 5, strung, asTheyAre, exact, false},
                                        {"cut", 5, deep, asTheyAre, hardness, true},
                                        {"spread", 5, dense, spread, exact, false},
                                        {"textures", 4, loose, textured, exact, false}};
    return list;
}

Scores scoresOf(const Flaw& flaw, int level) {
    const Trail trail = flaw.trail(level);
    TestView free{static_cast<int>(60 + trail.spacing * trail.puffs + speedPixels * frames), 130, {}};
    TestView exactly = free, asDrawn = free;
    if (flaw.ground) {
        exactly.ground = {65, 1, 1};
        asDrawn.ground = {65, 1, flaw.softness(level)};
    }
    const auto puffs = [&](int frame) { return trail.at(frame, 65); };

    // Metrics that need consecutive frames.
    PoppingOfRun run;
    std::vector<Plane> alphas, references;
    std::vector<Picture> images, referenceImages;
    for (int frame = 0; frame < frames; ++frame) {
        alphas.push_back(testAlpha(flaw.drawn(level, puffs(frame)), asDrawn));
        references.push_back(testAlpha(puffs(frame), exactly));
        images.push_back(testPicture(alphas.back()));
        referenceImages.push_back(testPicture(references.back()));
    }
    const auto frameAt = [&](std::size_t i) {
        return DustFrame{images[i], referenceImages[i], alphas[i], references[i]};
    };
    for (std::size_t i = 1; i < images.size(); ++i) run.summary.add(popping(frameAt(i - 1), frameAt(i)).value);

    // The others, for the middle frame.
    const std::size_t middle = frames / 2;
    const Puffs drawn = flaw.drawn(level, puffs(middle));
    // Textures and cuts affect the picture only: the method hands over its puffs unchanged.
    Puffs handedOver = drawn;
    for (TestPuff& puff : handedOver) puff.texture = -1;
    const Plane grid = testDepth(handedOver, free), referenceGrid = testDepth(puffs(middle), free);
    const std::array cells{free.width, free.height, 1};
    const Plane continuum = testAlpha(trail.at(middle, 65, 64), exactly);
    ComparedMoment moment{.picture = images[middle],
                          .reference = referenceImages[middle],
                          .alpha = alphas[middle],
                          .referenceAlpha = references[middle],
                          .mask = dustMask(alphas[middle], references[middle]),
                          .flip = flip(referenceImages[middle], images[middle]),
                          .alphaFree = testAlpha(drawn, free),
                          .referenceAlphaFree = testAlpha(puffs(middle), free),
                          .primitives = static_cast<std::int64_t>(drawn.size()),
                          .onScreen = testPrimitives(drawn),
                          .grid = GridCells{cells, grid.values},
                          .referenceGrid = GridCells{cells, referenceGrid.values},
                          .continuum = continuum,
                          .continuumPicture = testPicture(continuum),
                          .volumeAlpha = testAlpha(handedOver, exactly)};
    const MetricValues ofMoment = valuesOf(moment), ofRun = valuesOf(run);
    Scores scores;
    for (const Metric& metric : metrics())
        scores[std::string(metric.column)] = (metric.needs == Needs::pairs ? ofRun : ofMoment).of(metric.column);
    return scores;
}

/// The table's cells by row, then column: as written there, without back quotes.
using Responses = std::map<std::string, std::map<std::string, std::string>>;

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');) {
        std::erase(cell, '`');
        const auto first = cell.find_first_not_of(' ');
        cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') + 1 - first));
    }
    return cells;
}

const Responses& documented() {
    static const Responses table = [] {
        Responses rows;
        std::ifstream file(std::string(DUSTBENCH_SOURCE_DIR) + "/reports/METRICS.md");
        std::vector<std::string> header;
        for (std::string line; std::getline(file, line);) {
            if (line.starts_with("| metric |")) {
                header = cellsOf(line);
            } else if (!header.empty() && line.starts_with("| `")) {
                const std::vector<std::string> cells = cellsOf(line);
                for (std::size_t i = 1; i < std::min(cells.size(), header.size()); ++i)
                    rows[cells[0]][header[i]] = cells[i];
            }
        }
        return rows;
    }();
    return table;
}

/// Values of a metric by level.
using Series = std::vector<std::optional<double>>;

/// By flaw, then metric; computed once for all tests.
const std::map<std::string, std::map<std::string, Series>>& responses() {
    static const auto found = [] {
        std::map<std::string, std::map<std::string, Series>> all;
        for (const Flaw& flaw : flaws())
            for (int level = 0; level < flaw.levels; ++level)
                for (const auto& [metric, value] : scoresOf(flaw, level)) all[flaw.name][metric].push_back(value);
        return all;
    }();
    return found;
}

/// Identical pictures have no PSNR; they rank above any value.
double comparable(const std::optional<double>& value) {
    return value.value_or(std::numeric_limits<double>::infinity());
}

bool isCounted(const std::string& metric) {
    return metric == "components" || metric == "identical";
}

/// Maximum minus minimum of the present values.
double spanOf(const Series& series) {
    double minimum = std::numeric_limits<double>::infinity(), maximum = -minimum;
    for (const auto& value : series)
        if (value) {
            minimum = std::min(minimum, *value);
            maximum = std::max(maximum, *value);
        }
    return maximum < minimum ? 0 : maximum - minimum;
}

/// The largest span of a metric over the flaws for which the table says that it rises or falls.
double ownSpan(const std::string& metric) {
    double maximum = 0;
    for (const auto& [flaw, word] : documented().at(metric))
        if (word == "rises" || word == "falls") maximum = std::max(maximum, spanOf(responses().at(flaw).at(metric)));
    return maximum;
}

std::string textOf(const Series& series) {
    std::string text;
    for (const auto& value : series) text += value ? fmt::format(" {:.5f}", *value) : " empty";
    return text;
}

void expectMonotone(const std::string& metric, const Series& series, double sign) {
    for (std::size_t i = 1; i < series.size(); ++i) {
        const double before = sign * comparable(series[i - 1]), after = sign * comparable(series[i]);
        if (isCounted(metric)) {
            EXPECT_GE(after, before) << textOf(series);
        } else {
            EXPECT_GT(after, before) << textOf(series);
        }
    }
    EXPECT_GT(sign * comparable(series.back()), sign * comparable(series.front())) << textOf(series);
}

TEST(Metrics, AreDescribedAndHaveColumnsOfTheirOwn) {
    std::set<std::string_view> columns;
    for (const Metric& metric : metrics()) {
        EXPECT_TRUE(columns.insert(metric.column).second) << metric.column;
        for (const std::string_view text : {metric.title, metric.definition, metric.range, metric.perfect})
            EXPECT_FALSE(text.empty()) << metric.column;
        EXPECT_EQ(metric.needs == Needs::pairs, metric.overRun == OverRun::pairs || metric.overRun == OverRun::whole)
            << metric.column;
    }
}

TEST(MetricResponse, IsAsDocumented) {
    ASSERT_GE(documented().size(), 20u);
    for (const auto& [metric, row] : documented())
        for (const auto& [flaw, word] : row) {
            SCOPED_TRACE(flaw + " " + metric);
            ASSERT_TRUE(responses().contains(flaw) && responses().at(flaw).contains(metric));
            const Series& series = responses().at(flaw).at(metric);
            if (word == "rises") {
                expectMonotone(metric, series, 1);
            } else if (word == "falls") {
                expectMonotone(metric, series, -1);
            } else if (word == "stays") {
                const auto there = std::ranges::count_if(series, [](const auto& value) { return value.has_value(); });
                EXPECT_TRUE(there == 0 || there == std::ssize(series)) << textOf(series);
                EXPECT_LE(spanOf(series), 0.1 * ownSpan(metric)) << textOf(series);
            } else {
                EXPECT_EQ(word, "may");
            }
        }
}

TEST(MetricResponse, EveryMetricMovesWithSomeFlaw) {
    for (const auto& [metric, row] : documented())
        EXPECT_TRUE(std::ranges::any_of(row, [](const auto& cell) {
            return cell.second == "rises" || cell.second == "falls";
        })) << metric;
}

TEST(MetricResponse, IsPerfectForTheReferenceItself) {
    const Flaw& none = flaws().front();
    Scores scores = scoresOf(none, 0);
    const Plane alpha = testAlpha(none.trail(0).at(0, 65), {500, 130, {}});
    scores["gaps"] = gaps(alpha, alpha).value;
    scores["spill"] = spill(alpha, alpha).value;
    // The trail of single puffs is no reference for these, and its primitives have one size.
    for (const char* column :
         {"psnr_continuum_db", "popping_small", "popping_large", "popping_small_part", "popping_large_part"})
        scores.erase(column);
    for (const Metric& metric : metrics()) {
        SCOPED_TRACE(metric.column);
        const auto score = scores.find(std::string(metric.column));
        if (score == scores.end()) continue;
        if (metric.perfect == "identical") {
            EXPECT_FALSE(score->second);
        } else if (metric.perfect == "as the reference") {
            EXPECT_EQ(components(alpha, alpha).parts, components(alpha, alpha).referenceParts);
        } else if (metric.perfect != "any") {
            EXPECT_EQ(score->second, std::stod(std::string(metric.perfect)));
        }
    }
}

TEST(MetricResponse, SelfSimilarityIsTheShareOfPairsThatLookAlike) {
    // 50 puffs, each with one of k textures at random: 1 of k pairs is alike, and overlap leaves about 0.8 of their
    // correlation. Mean over ten clouds; a single one scatters by about 0.02.
    const Flaw& flaw = flaws().back();
    std::array<double, 4> mean{};
    constexpr int clouds = 10;
    for (std::size_t level = 0; level < mean.size(); ++level)
        for (int cloud = 0; cloud < clouds; ++cloud) {
            const Trail trail = flaw.trail(0);
            // A different section of an endless trail.
            Puffs puffs;
            for (TestPuff puff : Trail{50 * (cloud + 1), trail.spacing, trail.scatter, trail.jitter, 0}.at(0, 65)) {
                puff.x -= trail.spacing * 50 * cloud;
                puffs.push_back(puff);
            }
            puffs.erase(puffs.begin(), puffs.begin() + 50 * cloud);
            const TestView view{560, 130, {}};
            const Puffs drawn = texturedAs(cloud, static_cast<int>(level), puffs);
            const auto value = selfSimilarity(testAlpha(drawn, view), testAlpha(puffs, view), testPrimitives(drawn), 1);
            mean[level] += value.value.value() / clouds;
        }
    EXPECT_NEAR(mean[0], 0, 0.02);
    EXPECT_NEAR(mean[1], mean[3] / 16, 0.03);
    EXPECT_NEAR(mean[2], mean[3] / 4, 0.06);
    EXPECT_NEAR(mean[3], 0.79, 0.08);
}

}  // namespace
}  // namespace dustbench::measure
