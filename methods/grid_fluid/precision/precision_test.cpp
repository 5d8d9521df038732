#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "methods/contract/errors.h"
#include "methods/grid_fluid/precision/grid_problem.h"
#include "methods/grid_fluid/precision/precision_folder.h"
#include "methods/grid_fluid/precision/staggered_flow.h"
#include "methods/kit/files/csv.h"

namespace dustbench::grid_fluid::precision {
namespace {

namespace fs = std::filesystem;

/// A block in place of a car.
std::vector<std::uint8_t> blockIn(const flow::FluidBox& box) {
    std::vector<std::uint8_t> inside;
    for (int k = 0; k < box.cells.z; ++k)
        for (int j = 0; j < box.cells.y; ++j)
            for (int i = 0; i < box.cells.x; ++i) {
                const glm::dvec3 p = box.originMetres + (glm::dvec3(i, j, k) + 0.5) * box.spacingMetres;
                inside.push_back(p.x > -0.5 && p.x < 3 && p.y < 1.3 && std::abs(p.z) < 0.8 ? 1 : 0);
            }
    return inside;
}

constexpr flow::AdvectionRule revert{flow::AdvectionScheme::macCormack, flow::Limit::revert};

/// A shear wave u_x = sin(π·waves·y / height) on cells of 1.
StaggeredFlow wave(glm::ivec3 cells, double waves) {
    StaggeredFlow flow(cells);
    const glm::ivec3 faces = flow.faces(0);
    for (int k = 0; k < faces.z; ++k)
        for (int j = 0; j < faces.y; ++j)
            for (int i = 0; i < faces.x; ++i)
                flow.speeds[0][flow.face(0, i, j, k)] =
                    static_cast<float>(std::cos(std::numbers::pi * waves * (j + 0.5) / cells.y));
    std::ranges::fill(flow.density, 1.0f);
    return flow;
}

TEST(PrecisionProblem, BeginsFreeOfDivergenceAndStaysWithinItsTolerance) {
    for (const auto& [word, kind] : problemKinds.all()) {
        const GridProblem problem = problemOn(kind, 16, blockIn);
        const double spacing = problem.settings.box.spacingMetres;
        EXPECT_LT(sumsOf(problem.begin, problem.solids, spacing, problem.stepSeconds).divergencePerStep, 2e-5) << word;
        const SolvedProblem solved = solve(problem, revert);
        const double stored = sumsOf(solved.end, problem.solids, spacing, problem.stepSeconds).divergencePerStep;
        EXPECT_LT(stored, 1.01e-3) << word;
        EXPECT_GT(stored, 0) << word;
        EXPECT_GT(solved.cellsPerStep, 0.5) << word;
        EXPECT_LT(solved.cellsPerStep, 3) << word;
    }
}

TEST(PrecisionProblem, HasTheSameSmokeAndEnergyOnEveryGrid) {
    const auto begin = [](ProblemKind kind, int cells) {
        const GridProblem problem = problemOn(kind, cells, blockIn);
        const double spacing = problem.settings.box.spacingMetres;
        FlowSums sums = sumsOf(problem.begin, problem.solids, spacing, problem.stepSeconds);
        for (const flow::FluidSource& source : problem.sources)
            for (const float strength : strengthsOf(source, problem))
                sums.massM3 +=
                    static_cast<double>(strength * source.densityPerSecond) * std::pow(spacing, 3) * problem.seconds();
        return sums;
    };
    for (const auto& [word, kind] : problemKinds.all()) {
        const FlowSums coarse = begin(kind, 16), fine = begin(kind, 48);
        EXPECT_NEAR(coarse.massM3, fine.massM3, 0.05 * fine.massM3) << word;
        EXPECT_NEAR(coarse.energyM5PerS2, fine.energyM5PerS2, 0.1 * fine.energyM5PerS2) << word;
    }
    EXPECT_THROW((void)problemOn(ProblemKind::ring, 12, blockIn), InputError);
}

TEST(PrecisionProblem, ConvergesToItsFinestGrid) {
    for (const auto& [word, kind] : problemKinds.all()) {
        const auto after = [kind = kind](int cells) {
            const StaggeredFlow flow = solve(problemOn(kind, cells, blockIn), revert).end;
            return cells == 8 ? flow : averaged(flow, cells / 8);
        };
        const StaggeredFlow reference = after(32);
        const FlowDistance coarse = distanceOf(after(8), reference), fine = distanceOf(after(16), reference);
        EXPECT_LT(fine.density, 0.8 * coarse.density) << word;
        EXPECT_LT(fine.velocity, 0.9 * coarse.velocity) << word;
        EXPECT_LT(fine.spectrum, coarse.spectrum) << word;
    }
}

TEST(VortexRing, HasItsCirculationAndNoDivergence) {
    const flow::FluidBox box{{32, 32, 32}, 0.1, {0, 0, 0}};
    StaggeredFlow flow(box.cells);
    addRing({{1.6, 1.6, 1.6}, 0.6, 0.1, 2}, box, flow);
    EXPECT_LT(sumsOf(flow, {}, box.spacingMetres, 1).divergencePerStep, 1e-4);
    // Around the core where it crosses the plane z = 1.55, y > 1.6: along the edges of cells 12 to 20 and 18 to 26.
    double circulation = 0;
    for (int i = 12; i < 20; ++i)
        for (const auto& [j, sign] : {std::pair{18, 1.0}, {26, -1.0}})
            circulation += sign * 0.1 * static_cast<double>(flow.speeds[0][flow.face(0, i, j, 15)]);
    for (int j = 19; j < 26; ++j)
        for (const auto& [i, sign] : {std::pair{20, 1.0}, {12, -1.0}})
            circulation += sign * 0.1 * static_cast<double>(flow.speeds[1][flow.face(1, i, j, 15)]);
    // Γ·d²/(d² + a²) at the distance d of 0.4 m from the core.
    EXPECT_NEAR(circulation, 2 * 0.16 / 0.17, 0.05);
    EXPECT_NEAR(static_cast<double>(flow.speeds[0][flow.face(0, 16, 16, 16)]), 2 / (2 * 0.6), 0.1);
}

TEST(FlowDistance, EqualsClosedForms) {
    const StaggeredFlow one = wave({8, 16, 8}, 4);
    const FlowDistance none = distanceOf(one, one);
    EXPECT_EQ(none.density + none.velocity + none.enstrophy + none.spectrum, 0);
    StaggeredFlow half = one;
    for (float& speed : half.speeds[0]) speed /= 2;
    for (float& density : half.density) density *= 1.25f;
    // The other wave numbers contain only rounding errors.
    const FlowDistance apart = distanceOf(half, one);
    EXPECT_NEAR(apart.velocity, 0.5, 1e-6);
    EXPECT_NEAR(apart.density, 0.25, 1e-6);
    EXPECT_NEAR(apart.enstrophy, std::log(4.0), 1e-5);
}

TEST(FlowDistance, AveragesKeepMassAndWhatFlowsThroughFaces) {
    const GridProblem problem = problemOn(ProblemKind::ring, 16, blockIn);
    const double spacing = problem.settings.box.spacingMetres;
    const FlowSums fine = sumsOf(problem.begin, {}, spacing, 1),
                   coarse = sumsOf(averaged(problem.begin, 2), {}, 2 * spacing, 1);
    EXPECT_NEAR(coarse.massM3, fine.massM3, 1e-5);
    EXPECT_LT(coarse.divergencePerStep, 1.01 * fine.divergencePerStep);
}

class Folder : public testing::Test {
 protected:
    void SetUp() override { fs::remove_all(place_); }
    void TearDown() override { fs::remove_all(place_); }
    fs::path place_ = fs::path(testing::TempDir()) / "dustbench-precision";
};

TEST_F(Folder, ReadsBackItsFlowsAndRefusesOthers) {
    fs::create_directories(place_);
    const StaggeredFlow flow = problemOn(ProblemKind::ring, 8, blockIn).begin;
    writeFlow(place_ / "a.flow", flow);
    const StaggeredFlow again = readFlow(place_ / "a.flow");
    EXPECT_EQ(again.cells, flow.cells);
    EXPECT_EQ(again.density, flow.density);
    EXPECT_EQ(again.speeds, flow.speeds);
    const auto refused = [&](const std::string& text) {
        std::ofstream(place_ / "b.flow") << text;
        EXPECT_THROW((void)readFlow(place_ / "b.flow"), InputError) << text;
    };
    for (const char* text : {"", "dustbench-flow 2 1 1 1\n", "dustbench-flow 1 1 1\n", "dustbench-flow 1 -1 1 1\n",
                             "dustbench-flow 1 2000 1 1\n", "dustbench-flow 1 1 1 1\n"})
        refused(text);
    std::ofstream(place_ / "a.flow", std::ios::app) << "x";
    EXPECT_THROW((void)readFlow(place_ / "a.flow"), InputError);
    EXPECT_THROW((void)readFlow(place_), InputError);
}

TEST_F(Folder, RefusesDamagedFlowsBeforeItAllocates) {
    fs::create_directories(place_);
    const fs::path file = place_ / "a.flow";
    const std::string head = "dustbench-flow 1 2 1 1\n";
    const std::string whole = head + std::string(sizeof(float) * (2 + 3 + 4 + 4), '\0');
    const auto write = [&](const std::string& text) { std::ofstream(file, std::ios::binary) << text; };
    write(whole);
    EXPECT_EQ(readFlow(file).density.size(), 2u);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write(whole.substr(0, length));
        EXPECT_THROW((void)readFlow(file), InputError) << length;
    }
    for (std::size_t place = 0; place < head.size(); ++place)
        for (const char other : {'\0', ' ', '-', '1', '9', '\n', '\xff'}) {
            std::string text = whole;
            text[place] = other;
            write(text);
            try {
                EXPECT_EQ(readFlow(file).density.size(), 2u) << text;
            } catch (const InputError&) {
            }
        }
    write("dustbench-flow 1 1024 1024 1024\n" + whole.substr(head.size()));
    EXPECT_THROW((void)readFlow(file), InputError);  // 17 GB
    std::string text = whole;
    text.replace(text.size() - 4, 4, "\0\0\xc0\x7f", 4);
    write(text);
    EXPECT_THROW((void)readFlow(file), InputError);  // NaN
}

TEST_F(Folder, ComparesFlowsOfOtherSolversWithBothReferences) {
    const PrecisionFolder folder(place_);
    for (const int cells : {8, 16}) {
        const GridProblem problem = problemOn(ProblemKind::ring, cells, blockIn);
        folder.writeSetUp("ring", cells, problem);
        EXPECT_FALSE(folder.hasFlow("ring", cells, "revert"));
        const SolvedProblem solved = solve(problem, revert);
        folder.addRun("ring", cells, "revert", solved);
        EXPECT_TRUE(folder.hasFlow("ring", cells, "revert"));
        StaggeredFlow other = solved.end;
        for (float& density : other.density) density *= 1.5f;
        writeFlow(place_ / ("ring_" + std::to_string(cells)) / "other-any.flow", other);
    }
    std::ofstream(place_ / "times.csv", std::ios::app)
        << "ring,8,other,any,30\nring,8,other,any,12\nring,8,other,any,18\n";
    // Two flows against two references, and each reference against the other.
    EXPECT_EQ(folder.writePoints(8), 6u) << "only the finest flow of each solver is a reference";
    EXPECT_EQ(folder.writePoints(16), 6u);
    const files::CsvTable points = files::CsvTable::parseFile(place_ / "points.csv");
    ASSERT_EQ(points.rows(), 6u);
    for (std::size_t row = 0; row < points.rows(); ++row) {
        EXPECT_EQ(points.cell(row, "compared_cells"), "8");
        EXPECT_LT(points.number(row, "divergence_per_step"), 1.01e-3);
        if (points.cell(row, "solver") == "other" && points.cell(row, "cells") == "8") {
            EXPECT_NEAR(points.number(row, "ms_per_second"), 18 / 1.2, 1e-9);
            EXPECT_NEAR(points.number(row, "ms_per_second_high"), 30 / 1.2, 1e-9);
        }
        if (points.cell(row, "cells") == "16" && points.cell(row, "reference") == "dustbench") {
            EXPECT_NEAR(points.number(row, "density_error"), 0.5, 1e-5);
            EXPECT_EQ(points.number(row, "velocity_error"), 0);
        }
    }
}

}  // namespace
}  // namespace dustbench::grid_fluid::precision
