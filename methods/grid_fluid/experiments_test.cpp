#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>

#include "methods/grid_fluid/compositing_experiment.h"
#include "methods/grid_fluid/demo_memory_experiment.h"
#include "methods/grid_fluid/fire_experiment.h"
#include "methods/grid_fluid/large_steps_experiment.h"
#include "methods/grid_fluid/lego_experiment.h"
#include "methods/grid_fluid/marching_cubes_experiment.h"
#include "methods/grid_fluid/obstacles_experiment.h"
#include "methods/grid_fluid/scheme_accuracy_experiment.h"
#include "methods/grid_fluid/sight_experiment.h"
#include "methods/kit/draw/test_canvas.h"

namespace dustbench::grid_fluid {
namespace {

TEST(ObstacleExperiment, TellsAnObstacleFromNoneAndFromOneThatLeaks) {
    using obstacles::Obstacle;
    const auto measured = [](Obstacle obstacle) { return obstacles::measureObstacle({false, obstacle, 0, 3}); };
    const obstacles::ObstacleReport none = measured(Obstacle::none), ball = measured(Obstacle::ball);
    EXPECT_EQ(ball.smokeInside, 0);
    EXPECT_LT(ball.inflowM3PerSecond, 1e-5 * none.inflowM3PerSecond);
    EXPECT_GT(measured(Obstacle::perforatedBall).inflowM3PerSecond, 0.01 * none.inflowM3PerSecond);
    EXPECT_GT(none.smokeBehind, 0.1);
    EXPECT_LT(measured(Obstacle::wall).smokeBehind, 1e-4);
    EXPECT_GT(measured(Obstacle::holedWall).smokeBehind, 0.01);
}

TEST(LargeStepsExperiment, TellsAStableFlowFromOneThatGrowsAndFromOneThatStands) {
    large_steps::StepSettings settings;
    settings.cellsPerStep = 5;
    const large_steps::StepReport flows = large_steps::measureSteps(settings);
    EXPECT_LT(flows.energy, 1);
    EXPECT_GT(flows.energyLeft, 0.1);
    EXPECT_GT(flows.travelMetres, 0.1);
    settings.isFrozen = true;
    const large_steps::StepReport stands = large_steps::measureSteps(settings);
    EXPECT_EQ(stands.energy, 1);
    EXPECT_EQ(stands.travelMetres, 0);
    settings = {{flow::AdvectionScheme::macCormack, flow::Limit::none}, 20, false};
    EXPECT_GT(large_steps::measureSteps(settings).energy, 1.2);
}

TEST(LargeStepsExperiment, TheVelocityOfTheMiddleGainsNoEnergyEither) {
    using flow::AdvectionScheme, flow::Limit, flow::VelocityAt;
    for (const auto& [scheme, limit] :
         {std::pair{AdvectionScheme::semiLagrangian, Limit::none},
          std::pair{AdvectionScheme::macCormack, Limit::revert}, std::pair{AdvectionScheme::macCormack, Limit::clamp}})
        for (const double cellsPerStep : {2.0, 5.0, 20.0}) {
            const large_steps::StepReport report =
                large_steps::measureSteps({{scheme, limit, VelocityAt::middle}, cellsPerStep, false});
            EXPECT_LE(report.energy, 1) << static_cast<int>(limit) << " in steps of " << cellsPerStep;
            EXPECT_GT(report.travelMetres, 0.1);
        }
}

TEST(SchemeAccuracyExperiment, MeasuresDistancesThatFallAsTheGridIsRefined) {
    using namespace scheme_accuracy;
    constexpr int cells = 8;
    const auto after = [](flow::AdvectionScheme scheme, int refinement) {
        return jetAfter(0.5, scheme, cells, refinement, 3);
    };
    const CoarseFlow reference = after(flow::AdvectionScheme::semiLagrangian, 4);
    const Distance none = distanceOf(reference, reference, cells);
    EXPECT_EQ(none.density + none.picture + none.velocity + none.enstrophy + none.detail, 0);
    const Distance coarse = distanceOf(after(flow::AdvectionScheme::semiLagrangian, 1), reference, cells),
                   finer = distanceOf(after(flow::AdvectionScheme::semiLagrangian, 2), reference, cells);
    for (const auto of :
         {&Distance::density, &Distance::picture, &Distance::velocity, &Distance::enstrophy, &Distance::detail})
        EXPECT_LT(finer.*of, 0.7 * coarse.*of);
    // A flow of half the speed has a quarter of the enstrophy and of the detail.
    CoarseFlow slower = reference;
    for (std::vector<float>& speed : slower.velocity)
        for (float& value : speed) value /= 2;
    const Distance half = distanceOf(slower, reference, cells);
    EXPECT_EQ(half.density, 0);
    EXPECT_NEAR(half.velocity, 0.5, 1e-6);
    EXPECT_NEAR(half.enstrophy, std::log(4.0), 1e-5);
    EXPECT_NEAR(half.detail, std::log(4.0), 1e-5);
}

TEST(FireExperiment, ShowsTheSameMassAsParticlesAndAsAVolume) {
    // Thin pieces, wide enough for the grid: their two pictures differ only by the grid's interpolation.
    std::vector<fire::Flake> pieces = fire::scatter(5, 0.16, 7);
    for (fire::Flake& piece : pieces) piece.depth = 0.01;
    const fire::Picture particles = fire::pictureOf(pieces, {}, 32),
                        volume = fire::pictureOf(fire::gridOf(pieces, 20), {}, 32);
    EXPECT_LT(fire::distanceOf(volume, particles), 0.1);
    const auto sumOf = [](const fire::Picture& picture) {
        return std::accumulate(picture.alphas.begin(), picture.alphas.end(), 0.0);
    };
    EXPECT_NEAR(sumOf(volume) / sumOf(particles), 1, 0.02);
    EXPECT_EQ(fire::distanceOf(particles, particles), 0);
    // A fire and its particles have the same amount of smoke.
    fire::Burning burning = fire::burn(16, 0.4, 3000, 3);
    for (fire::Flake& flake : burning.particles) {
        flake.deviation = 0.1;
        flake.depth /= 2 * std::numbers::pi * 0.01 * 1000;
    }
    for (float& density : burning.grid.density) density /= 1000;
    const raycast::TransferFunction smoke({{0, glm::vec3(0), 1}, {1, glm::vec3(0), 1}});
    EXPECT_NEAR(sumOf(fire::pictureOf(burning.particles, smoke, 32)) / sumOf(fire::pictureOf(burning.grid, smoke, 32)),
                1, 0.05);
}

TEST(FireExperiment, CorrelatesWhatBurnsWithWhatIsSeen) {
    const fire::FireGrid grid = fire::burn(16, 0.6, 0, 3).grid;
    const fire::Picture freshness = fire::freshnessOf(grid, 32);
    EXPECT_GT(fire::correlationOf(fire::pictureOf(grid, {}, 32), freshness), 0.95);
    const raycast::TransferFunction backwards({{0, glm::vec3(3), 1}, {1, glm::vec3(0), 1}});
    EXPECT_LT(fire::correlationOf(fire::pictureOf(grid, backwards, 32), freshness), -0.95);
}

TEST(FireExperiment, AFieldIsShownAsTheGridThatHoldsIt) {
    // A burning puff, wide enough for the cells.
    const auto field = [](const glm::dvec3& place) {
        const glm::dvec3 aside = (place - glm::dvec3(0.7, 1.5, 0.8)) / 0.25;
        return glm::dvec2(std::exp(-glm::dot(aside, aside) / 2), std::clamp(place.y - 1, 0.0, 1.0));
    };
    constexpr int cells = 32;
    fire::FireGrid grid{cells, {}, {}};
    for (int z = 0; z < cells; ++z)
        for (int y = 0; y < 2 * cells; ++y)
            for (int x = 0; x < cells; ++x) {
                const glm::dvec2 there = field((glm::dvec3(x, y, z) + 0.5) * grid.spacingMetres());
                grid.density.push_back(static_cast<float>(there.x));
                grid.reaction.push_back(static_cast<float>(there.y));
            }
    const fire::FieldPictures shown = fire::picturesOf(field, grid.spacingMetres(), {}, 32);
    EXPECT_LT(fire::distanceOf(shown.shown, fire::pictureOf(grid, {}, 32)), 0.01);
    EXPECT_LT(fire::distanceOf(shown.freshness, fire::freshnessOf(grid, 32)), 0.01);
}

TEST(FireExperiment, GridsConvergeToTheFireThatPathsGive) {
    // Everything that the source emitted is on some path. The flow is that of the grid, so only the transport differs.
    constexpr double seconds = 0.5;
    std::array<double, 3> apart{};
    for (std::size_t k = 0; k < apart.size(); ++k) {
        const int cells = 12 << k;
        const fire::Burning fire = fire::burn(cells, seconds, 0, 3, fire::Paths::kept);
        apart[k] = fire::distanceOf(fire::pictureOf(fire.grid, {}, 24),
                                    fire::picturesOf(fire.field, fire::widthMetres / 48, {}, 24).shown);
    }
    EXPECT_LT(apart[1], 0.6 * apart[0]);
    EXPECT_LT(apart[2], 0.6 * apart[1]);
    EXPECT_LT(apart[2], 0.1);
}

TEST(FireExperiment, CountsThePiecesThatStandOut) {
    const std::vector<fire::Flake> apart = {{{0.4, 0.5, 0.8}, 0.02, 0.5, 0}, {{0.8, 1.5, 0.2}, 0.02, 0.5, 0}},
                                   alike = {{{0.4, 0.5, 0.8}, 0.02, 0.5, 0}, {{0.4, 0.5, 0.2}, 0.02, 0.5, 0}};
    EXPECT_EQ(fire::piecesSeen(fire::pictureOf(apart, {}, 256), apart), 1);
    EXPECT_EQ(fire::piecesSeen(fire::pictureOf(alike, {}, 256), alike), 0.5);
    EXPECT_EQ(fire::piecesSeen(fire::pictureOf({apart[0]}, {}, 256), apart), 0.5);
}

/// The harness's context, but without worlds: this experiment requests none.
class Context final : public ExperimentContext {
 public:
    [[nodiscard]] std::uint64_t seed() const override { return 1; }
    [[nodiscard]] bool quick() const override { return true; }
    [[nodiscard]] gpu::Device& device() override { return draw::TestCanvas::device(); }
    [[nodiscard]] std::unique_ptr<ExperimentWorld> world(const std::string&, const std::map<std::string, std::string>&,
                                                         int, int) override {
        ADD_FAILURE() << "a world was requested";
        return nullptr;
    }
};

TEST(SightExperiment, FindsWhatIsDrawnWrong) {
    Context context;
    std::map<std::string, double> errors;
    for (const Finding& finding : sight::describe().run(context)) errors[finding.quantity] = finding.value;
    ASSERT_EQ(errors.size(), 7u);
    for (const auto& [name, error] : errors) EXPECT_EQ(error < 1e-4, name != "solid_unseen") << name << " " << error;
    EXPECT_GT(errors["solid_unseen"], 0.1);
    // A ray that stops at an alpha of one half omits the other half.
    raycast::RaycastSettings settings;
    settings.stopAlpha = 0.5;
    EXPECT_GT(sight::maximumSightError(context.device(), settings, {{{0, 0, 9}, {0, 0, -1}, {}}}), 0.1);
}

/// A picture whose alpha is a function of the pixel.
template <typename Alpha>
pictures::Image imageOf(int width, int height, const Alpha& alpha) {
    pictures::Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.pixels.emplace_back(0, 0, 0, static_cast<float>(alpha(x, y)));
    return image;
}

TEST(LegoExperiment, MeasuresTheJumpsAtBordersByTheCloudsOwnChange) {
    constexpr int edge = 4 * lego::pixelsPerCell;
    constexpr double slope = 1.0 / 64;
    const pictures::Image exact = imageOf(edge, edge, [&](int x, int y) { return slope * (x + y); });
    EXPECT_EQ(lego::blocksOf(exact, exact), 0);
    // One value for each cell: a border adds the changes of the seven pixels before it.
    const auto middle = [](int x) {
        const int cell = x / lego::pixelsPerCell;
        return (cell + 0.5) * lego::pixelsPerCell - 0.5;
    };
    const pictures::Image blocks = imageOf(edge, edge, [&](int x, int y) { return slope * (middle(x) + middle(y)); });
    EXPECT_NEAR(lego::blocksOf(blocks, exact), lego::pixelsPerCell - 1, 1e-4);
    // Errors away from borders do not count.
    const pictures::Image shifted = imageOf(edge, edge, [&](int x, int y) { return slope * (x + y) + 0.1; });
    EXPECT_NEAR(lego::blocksOf(shifted, exact), 0, 1e-4);
}

TEST(LegoExperiment, SeesBlocksOfNearestSamplingAlone) {
    for (const raycast::Backend backend : {raycast::Backend::gl, raycast::Backend::cpu}) {
        raycast::RaycastSettings settings;
        settings.backend = backend;
        settings.jitter = false;
        const auto blocksBy = [&](raycast::Filter filter) {
            settings.filter = filter;
            return lego::blocksSeen(draw::TestCanvas::device(), settings, 12, 3);
        };
        EXPECT_GT(blocksBy(raycast::Filter::nearest), 3);
        EXPECT_LT(blocksBy(raycast::Filter::linear), 0.3);
        EXPECT_LT(blocksBy(raycast::Filter::cubic), 0.5);
    }
}

TEST(CompositingExperiment, IsTheSameFromEitherSideAndStopsBeyondAnAlpha) {
    using compositing::Sample;
    const std::array samples{Sample{{1, 0, 0}, 0.5f}, Sample{{0, 1, 0}, 0.5f}, Sample{{0, 0, 1}, 1}};
    const glm::vec4 seen(0.5f, 0.25f, 0.25f, 1);
    EXPECT_EQ(compositing::frontToBack(samples, 1).seen, seen);
    EXPECT_EQ(compositing::backToFront(samples).seen, seen);
    EXPECT_EQ(compositing::frontToBack(samples, 1).samples, 3);
    const compositing::Composite stopped = compositing::frontToBack(samples, 0.6f);
    EXPECT_EQ(stopped.samples, 2);
    EXPECT_EQ(stopped.seen, glm::vec4(0.5f, 0.25f, 0, 0.75f));
}

TEST(CompositingExperiment, ComparesMarchAndSlicesAtTheSamePlaces) {
    Context context;
    std::map<std::string, double> found;
    for (const Finding& finding : compositing::describe().run(context)) found[finding.quantity] = finding.value;
    EXPECT_LT(found.at("orders_formulas"), 1e-5);
    EXPECT_LT(found.at("orders_gl"), 1e-4);
    EXPECT_GT(found.at("orders_wrong"), 0.1);
    EXPECT_EQ(found.at("saved_2"), 0);
    EXPECT_GT(found.at("saved_40"), found.at("saved_10"));
    EXPECT_GT(found.at("saved_10"), 0.02);
}

TEST(MarchingCubesExperiment, CountsTheKnownClasses) {
    // By Burnside's lemma: 23 colourings of a cube's corners with two colours under rotations, 22 with reflections.
    EXPECT_EQ(marching_cubes::classesOf(false, false), 23);
    EXPECT_EQ(marching_cubes::classesOf(true, false), 22);
    EXPECT_EQ(marching_cubes::classesOf(false, true), 15);
    EXPECT_EQ(marching_cubes::classesOf(true, true), 14);
}

TEST(DemoMemoryExperiment, CountsTheBytesOfThePaper) {
    const auto measure = [](bool asPublished) {
        return demo_memory::measureMemory(draw::TestCanvas::device(), {16, 8, 8}, {32, 20}, asPublished);
    };
    EXPECT_EQ(measure(true).fields, (32 + 9) * 1024u);
    EXPECT_EQ(measure(true).picture, 20 * 640u);
    EXPECT_GT(measure(false).fields, 2 * measure(true).fields);
}

}  // namespace
}  // namespace dustbench::grid_fluid
