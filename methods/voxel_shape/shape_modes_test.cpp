// Tests the options of a run with shapes: the paper's law or ours, a requested number of particles, several shapes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/voxel_shape/resolution_experiment.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/voxel_shape.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

/// Writes the file of a ball 2 m across, at rest.
std::filesystem::path ballFile(const TestFolder& folder, const std::string& more = "") {
    const scene::Mesh ball = sphereMesh(1, 16);
    std::string text;
    for (const glm::vec3& p : ball.positions)
        text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    for (std::size_t i = 0; i < ball.indices.size(); i += 3)
        text += "f " + std::to_string(ball.indices[i] + 1) + " " + std::to_string(ball.indices[i + 1] + 1) + " " +
                std::to_string(ball.indices[i + 2] + 1) + "\n";
    folder.write("ball.obj", text);
    return folder.write("ball.toml", "description = \"\"\nmesh = \"ball.obj\"\nresolution = 20\nparticles = 4000\n" +
                                         more + "[place]\nfollow = \"world\"\n");
}

/// Creates the method with a preset and settings, as a run does.
std::unique_ptr<Method> presetWith(const std::vector<std::pair<const char*, const char*>>& settings) {
    const MethodInfo info = voxel_shape::describe();
    ParameterValues values(info.parameters);
    for (const auto& [name, value] : settings) values.set(name, value);
    return info.create(values);
}

TEST(ShapeFile, MeshesLieBesideTheFileElseAmongTheData) {
    const TestFolder folder;
    const auto shapeWith = [&](const std::string& keys) {
        return readShape(folder.write("mine.toml", "description = \"\"\n" + keys + "\n[place]\nfollow = \"world\"\n"));
    };
    const std::filesystem::path hare = files::dataFolder() / "shapes/meshes/hare.ply";
    EXPECT_EQ(shapeWith("mesh = \"meshes/hare.ply\"").mesh, hare);
    EXPECT_EQ(shapeWith("mesh = \"none.ply\"\nmesh_otherwise = \"meshes/hare.ply\"").mesh, hare);
    (void)ballFile(folder);
    EXPECT_EQ(shapeWith("mesh = \"ball.obj\"\nmesh_otherwise = \"meshes/hare.ply\"").mesh, folder.path() / "ball.obj");
    EXPECT_THAT(inputError([&] { (void)shapeWith("mesh = \"bal.obj\""); }),
                testing::AllOf(testing::HasSubstr("mine.toml:2"),
                               testing::HasSubstr("tried " + (folder.path() / "bal.obj").string()),
                               testing::HasSubstr((files::dataFolder() / "shapes/bal.obj").string()),
                               testing::HasSubstr("did you mean '" + (folder.path() / "ball.obj").string() + "'?")));
}

class ModesMoment : public TestMoment {
 public:
    ModesMoment() : TestMoment(0, 160, 120, {0, 1, 5}, {0, 0, -1}) {}

    void run(Method& method, int steps) {
        method.prepare(scene, {}, device());
        for (int step = 0; step < steps; ++step) method.update(frame());
    }
    std::optional<FactValue> fact(const Method& method, const char* name) {
        const std::vector<FactInfo> declared = voxel_shape::describe().facts;
        for (const FactOver over : {FactOver::lastFrame, FactOver::maximumOfFrames}) {
            Facts facts(declared, over);
            method.report(frame(), facts);
            if (facts.value(name)) return facts.value(name);
        }
        return std::nullopt;
    }
};

/// The figure's file sets 4 pixels. With 10 instead of 50 voxels per side its particles are wider than that and cover
/// it.
TEST(ShapeModes, ParticlesAreAsWideAsTheFileSaysOrAsTheyAreThemselves) {
    const auto covered = [](const char* pixels) {
        TestMoment moment(0, 320, 240, {-4, 1.6, 8}, {0, 0, -1});
        moment.scene.vehicle.emplace();
        const auto method = presetWith({{"shape", "figure"},
                                        {"resolution", "10"},
                                        {"particles_per_voxel", "6"},
                                        {"fill_seconds", "0"},
                                        {"sprite_pixels", pixels}});
        method->prepare(moment.scene, {}, TestMoment::device());
        for (int step = 0; step < 3; ++step) method->update(moment.frame());
        return std::ranges::count_if(moment.draw(*method).pixels, [](const glm::vec4& p) { return p.a > 0.5f; });
    };
    const auto asInTheFile = covered("-1");
    EXPECT_GT(asInTheFile, 0);
    EXPECT_EQ(asInTheFile, covered("4"));
    EXPECT_GT(covered("0"), 3 * asInTheFile);
}

const ShapeSystem& systemOf(const Method& method) {
    return dynamic_cast<const VoxelShape&>(method).system();
}

TEST(ShapeModes, OfThePaperTakeItsSlicesAndItsLaw) {
    ModesMoment moment;
    moment.scene.vehicle.emplace();  // the figure follows it
    const auto activeAndHeld = [&](const std::vector<std::pair<const char*, const char*>>& more) {
        std::vector<std::pair<const char*, const char*>> settings{
            {"shape", "figure"}, {"shape_particles", "8000"}, {"resolution", "24"}};
        settings.insert(settings.end(), more.begin(), more.end());
        const auto method = presetWith(settings);
        moment.run(*method, 240);
        return std::pair(systemOf(*method).grid().active().size(), systemOf(*method).count().inside);
    };
    const auto ours = activeAndHeld({}), paper = activeAndHeld({{"mode", "paper"}}),
               slices = activeAndHeld({{"voxeliser", "slices"}}),
               law = activeAndHeld({{"mode", "paper"}, {"voxeliser", "conservative"}});
    EXPECT_LT(paper.first, ours.first * 7 / 10) << "slices miss much";
    EXPECT_EQ(slices.first, paper.first);
    EXPECT_EQ(law.first, ours.first);
    EXPECT_LE(ours.second, 8000u);
    EXPECT_LE(slices.second, 8000u);
    EXPECT_GT(law.second, 8100u) << "maximum density limits only births";
    EXPECT_GT(paper.second, 8100u);
}

TEST(ShapeModes, OfThePaperIsTheLawOfTheOtherShapesToo) {
    const TestFolder folder;
    folder.write("drifting.toml",
                 "description = \"\"\nparticles = 2000\n[grid]\ncells = [8, 8, 8]\nedge_metres = 0.25\n"
                 "[motion]\nbirth_speed = 0.4\n[place]\nfollow = \"world\"\n");
    const auto both =
        folder.write("both.toml",
                     "description = \"\"\nparticles = 64\n[grid]\ncells = [4, 4, 4]\nedge_metres = 0.25\n[place]\n"
                     "follow = \"world\"\nposition = [9, 0, 0]\n[[also]]\nshape = \"drifting.toml\"\n");
    const auto insideAfter = [&](const char* mode) {
        ModesMoment moment;
        const auto method = presetWith({{"shape", both.c_str()}, {"mode", mode}});
        moment.run(*method, 90);
        return std::get<std::int64_t>(*moment.fact(*method, "inside"));
    };
    EXPECT_LE(insideAfter("fixed"), 2064);
    EXPECT_GT(insideAfter("paper"), 2200) << "the first shape alone is at rest and holds its 64";
}

TEST(ShapeModes, ANumberIsHeldToItsVeryMargin) {
    const TestFolder folder;
    Shape shape = readShape(ballFile(folder, "[motion]\nbirth_speed = 0.1\nfill_seconds = 0.1\n"));
    const auto insideWithin = [&](double margin) {
        ModesMoment moment;
        shape.heldWithin = margin;
        const auto method = std::make_unique<VoxelShape>(shape);
        moment.run(*method, 60);
        return std::get<std::int64_t>(*moment.fact(*method, "inside"));
    };
    const double off = 1 - static_cast<double>(insideWithin(0)) / 4000;
    ASSERT_GT(off, 1e-3);
    EXPECT_NO_THROW((void)insideWithin(1.01 * off));
    EXPECT_THROW((void)insideWithin(0.99 * off), std::runtime_error);
}

TEST(ShapeModes, OfThePaperCannotFillASolid) {
    const std::string message = inputError([] { (void)presetWith({{"shape", "ball"}, {"mode", "paper"}}); });
    EXPECT_NE(message.find("needs voxeliser=conservative"), std::string::npos) << message;
}

TEST(ShapeModes, ARunThatDoesNotHoldItsNumberIsNone) {
    const TestFolder folder;
    Shape shape = readShape(ballFile(folder, "[motion]\nbirth_speed = 0.02\nfill_seconds = 0.05\n"));
    shape.heldWithin = 0.02;
    ModesMoment moment;
    const auto held = std::make_unique<VoxelShape>(shape), early = std::make_unique<VoxelShape>(shape);
    moment.run(*held, 60);
    EXPECT_NEAR(static_cast<double>(std::get<std::int64_t>(*moment.fact(*held, "inside"))), 4000, 80);
    EXPECT_LT(std::get<std::int64_t>(*moment.fact(*held, "fading")), 1000);
    EXPECT_GT(std::get<double>(*moment.fact(*held, "silhouette_iou")), 0.7) << "puffs reach beyond the outline";
    // In the first step only a third of them exist.
    moment.run(*early, 1);
    try {
        (void)moment.fact(*early, "inside");
        FAIL() << "expected an error";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("allowed: 4000 within 2 %"), std::string::npos) << error.what();
    }
}

TEST(ShapeModes, SeveralShapesAreDrawnTogetherAndCrossEachOther) {
    const TestFolder folder;
    (void)ballFile(folder);
    const auto both =
        folder.write("both.toml",
                     "description = \"\"\nparticles = 512\n[grid]\ncells = [8, 8, 8]\nedge_metres = 0.25\n"
                     "[place]\nfollow = \"world\"\n[[also]]\nshape = \"moving.toml\"\n");
    folder.write("moving.toml",
                 "description = \"\"\nmesh = \"ball.obj\"\nresolution = 20\nparticles = 4000\n[place]\n"
                 "follow = \"world\"\n[[place.key]]\ntime_seconds = 0\nposition = [-3, 1, 0]\n"
                 "[[place.key]]\ntime_seconds = 2\nposition = [3, 1, 0]\n");
    ModesMoment moment;
    const auto method = std::make_unique<VoxelShape>(readShape(both));
    method->prepare(moment.scene, {}, ModesMoment::device());
    for (int step = 0; step < 60; ++step) {
        moment.state.timeSeconds = step / 60.0;
        method->update(moment.frame());
        ASSERT_EQ(method->primitives(), std::get<std::int64_t>(*moment.fact(*method, "inside")) +
                                            std::get<std::int64_t>(*moment.fact(*method, "fading")));
    }
    EXPECT_GT(method->primitives(), 4400);
    const auto& drawn = systemOf(*method).particles().store;
    EXPECT_GT(*std::ranges::max_element(drawn.velocityX), 0.5f) << "the ball has dragged part of the block along";
    EXPECT_EQ(*std::ranges::max_element(drawn.velocityZ), 0);
    const std::string message = inputError([&] {
        folder.write("three.toml", "description = \"\"\nmesh = \"ball.obj\"\n[[also]]\nshape = \"both.toml\"\n");
        (void)readShape(folder.path() / "three.toml");
    });
    EXPECT_NE(message.find("a single shape"), std::string::npos) << message;
}

TEST(Resolution, FindsTheKneeOfACurveThatSaturates) {
    // 1 − e^(−x/30) between 10 and 120 is highest above its chord where its slope equals the chord's.
    resolution::Curve curve;
    for (int side = 10; side <= 120; side += 2) {
        curve.voxelsASide.push_back(side);
        curve.overlaps.push_back(1 - std::exp(-(side - 10) / 30.0));
    }
    const double slope = curve.overlaps.back() / 110;
    EXPECT_NEAR(curve.knee(), 10 - 30 * std::log(30 * slope), 2);
    EXPECT_EQ((resolution::Curve{{10, 20, 30}, {0.5, 0.5, 0.5}}.knee()), 10);
    EXPECT_EQ((resolution::Curve{{10, 20, 30}, {0.5, 0.9, 0.9}}.knee()), 20);
}

}  // namespace
}  // namespace dustbench::voxel_shape
