#include "bench/world/panel_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "bench/world/scene_file.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::world {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// 3 × 2 texels; the upper row is 0, 128, 255.
std::string smallHeights() {
    return std::string("P5\n3 2\n255\n") + std::string("\x00\x80\xff\xff\xff\x00", 6);
}

class PanelTest : public testing::Test {
 protected:
    PanelTest() {
        folder_.write("heights.pgm", smallHeights());
        folder_.write("relief.toml", "description = \"r\"\nheights = \"heights.pgm\"\ncolour = [0.1, 0.2, 0.3]\n");
    }

    SceneFile scene(const std::string& panels) {
        return readScene(folder_.write("s.toml", "description = \"d\"\n" + panels));
    }
    std::string message(const std::string& panels) {
        return inputError([&] { static_cast<void>(scene(panels)); });
    }
    static std::string panel(const std::string& name, const std::string& keys) {
        return "[[panel]]\nname = \"" + name + "\"\nrelief = \"./relief.toml\"\n" + keys;
    }

    TestFolder folder_;
    const std::string wall_ = "position = [5, 1, 0]\nsize_metres = [4, 2]\ndepth_metres = 0.1\n";
};

TEST_F(PanelTest, ReliefsAreReadFromTheLowestRowUpAndWhiteIsAtTheFace) {
    const ReliefFile file = readRelief(folder_.path() / "relief.toml");
    EXPECT_EQ(file.relief->columns, 3);
    EXPECT_EQ(file.relief->rows, 2);
    ASSERT_EQ(file.relief->depth.size(), 6u);
    EXPECT_FLOAT_EQ(file.relief->depth[0], 0);
    EXPECT_FLOAT_EQ(file.relief->depth[2], 1);
    EXPECT_FLOAT_EQ(file.relief->depth[3], 1);
    EXPECT_FLOAT_EQ(file.relief->depth[4], 1 - 128.0f / 255);
    EXPECT_EQ(file.relief->colour[5], glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(file.files.size(), 2u);
}

TEST_F(PanelTest, StandsWhereTheFileSaysAndGoesAlongWithTheVehicle) {
    const SceneFile file = scene(panel("wall", wall_ + "rotation_degrees = [0, 90, 0]\n") +
                                 panel("plate",
                                       "parent = \"vehicle\"\nposition = [-1, 0.5, 0]\nsize_metres = [0.5, 0.2]\n"
                                       "depth_metres = 0.01\n"));
    ASSERT_EQ(file.scene.panels.size(), 2u);
    EXPECT_EQ(file.scene.panels[0].relief->rows, 2);
    scene::SceneState state;
    state.vehicle.position = {100, 0, 7};
    const glm::dmat4 wall = panelToWorld(file.scene.panels[0], state);
    EXPECT_LT(glm::distance(glm::dvec3(wall[3]), glm::dvec3(5, 1, 0)), 1e-12);
    EXPECT_LT(glm::distance(glm::dvec3(wall[2]), glm::dvec3(1, 0, 0)), 1e-12);  // the face, turned from +Z to +X
    const glm::dmat4 plate = panelToWorld(file.scene.panels[1], state);
    EXPECT_LT(glm::distance(glm::dvec3(plate[3]), glm::dvec3(99, 0.5, 7)), 1e-12);
}

TEST_F(PanelTest, SaysWhatIsWrongOfBadInput) {
    EXPECT_NO_THROW(static_cast<void>(scene(panel("wall", wall_))));
    EXPECT_THAT(message(panel("wall", "position = [0, 0.5, 0]\nsize_metres = [4, 2]\ndepth_metres = 0.1\n")),
                HasSubstr("extends into the ground"));
    EXPECT_THAT(message(panel("wall", wall_) + panel("other", wall_)), HasSubstr("'other' overlaps panel 'wall'"));
    EXPECT_THAT(message(panel("wall", wall_) + panel("wall", wall_)), HasSubstr("two panels have the name 'wall'"));
    for (const char* size : {"[0, 2]", "[-4, 2]", "[4]", "[4, 2, 1]", "[4, nan]"})
        EXPECT_THAT(message(panel(
                        "wall", "position = [5, 1, 0]\ndepth_metres = 0.1\nsize_metres = " + std::string(size) + "\n")),
                    HasSubstr("size_metres"))
            << size;
    EXPECT_THAT(message(panel("wall", "position = [5, 1, 0]\nsize_metres = [4, 2]\ndepth_metres = 0\n")),
                HasSubstr("depth_metres"));
    for (const char* depth : {"-0.1", "nan", "inf", "1e-9"})  // a mirrored plate has a negative depth or size
        EXPECT_THAT(message(panel("wall", "position = [5, 1, 0]\nsize_metres = [4, 2]\ndepth_metres = " +
                                              std::string(depth) + "\n")),
                    HasSubstr("depth_metres"))
            << depth;
    EXPECT_THAT(message(panel("wall", "position = [nan, 1, 0]\nsize_metres = [4, 2]\ndepth_metres = 0.1\n")),
                HasSubstr("position"));
    EXPECT_THAT(message(panel("wall", "position = [5, 1, 0]\nsize_metres = [4, 2]\n")), HasSubstr("depth_metres"));
    EXPECT_THAT(message(panel("wall", wall_ + "parent = \"car\"\n")), HasSubstr("one of world, vehicle"));
    for (const char* bend : {"[0.1]", "[nan, 0]", "0.1"})
        EXPECT_THAT(message(panel("wall", wall_ + "curvature_per_metre = " + bend + "\n")),
                    HasSubstr("curvature_per_metre"));
    for (const char* bend : {"[0.6, 0]", "[0, 1.1]", "[0.1, 0, 0]"})
        EXPECT_THAT(message(panel("wall", wall_ + "curvature_per_metre = " + bend + "\n")),
                    HasSubstr("within -0.5..0.5 and -1..1 for this size and depth"));
    // The rims of a bulging face would be below the ground.
    EXPECT_THAT(message(panel("floor",
                              "position = [5, 0.2, 0]\nrotation_degrees = [-90, 0, 0]\nsize_metres = [4, 2]\n"
                              "depth_metres = 0.1\ncurvature_per_metre = [0.2, 0]\n")),
                HasSubstr("extends into the ground"));
    EXPECT_THAT(message("[[panel]]\nname = \"w\"\nrelief = \"brick\"\n" + wall_), HasSubstr("did you mean 'bricks'?"));
    EXPECT_THAT(message("[[panel]]\nname = \"w\"\nrelief = \"./none.toml\"\n" + wall_), HasSubstr("none.toml"));
}

TEST_F(PanelTest, SaysWhatIsWrongWithHeights) {
    const auto reason = [&](const std::string& heights) {
        folder_.write("bad.pfm", heights);
        folder_.write("bad.toml", "description = \"r\"\nheights = \"bad.pfm\"\n");
        return inputError([&] { static_cast<void>(readRelief(folder_.path() / "bad.toml")); });
    };
    EXPECT_THAT(reason("P5\n1 1\n255\nx"), HasSubstr("1x1 texels, allowed: 2..8192 a side"));
    EXPECT_THAT(reason("P5\n9000 2\n255\n" + std::string(18000, 'x')), HasSubstr("9000x2"));
    EXPECT_THAT(reason("nothing"), HasSubstr("not an image"));
    // There are no pixels: the size is refused before they are read.
    for (const char* header :
         {"P5\n9000 9000\n255\n", "P5\n60000 60000\n255\n", "P5\n2 8193\n255\n", "P5\n1 64\n255\n"})
        EXPECT_THAT(reason(header), HasSubstr("allowed: 2..8192 a side")) << header;
    // From 2.5 on OpenImageIO refuses more than 65,535 pixels a side in its own words, which also name the size.
    EXPECT_THAT(reason("P5\n100000 100000\n255\n"), AllOf(HasSubstr("100000x100000"), Not(HasSubstr("\n"))));
    EXPECT_THAT(reason("P5\n8 8\n255\nshort"), HasSubstr("bad.pfm"));
    folder_.write("missing.toml", "description = \"r\"\nheights = \"none.png\"\n");
    EXPECT_THAT(inputError([&] { static_cast<void>(readRelief(folder_.path() / "missing.toml")); }),
                HasSubstr("none.png: not an image that can be read"));
    folder_.write("large.pgm", "P5\n9000 9000\n255\n");
    folder_.write("large.toml", "description = \"r\"\nheights = \"heights.pgm\"\ncolours = \"large.pgm\"\n");
    EXPECT_THAT(inputError([&] { static_cast<void>(readRelief(folder_.path() / "large.toml")); }),
                HasSubstr("large.pgm: has 9000x9000 texels"));
    const float notANumber[4] = {0, NAN, 0, 0};
    EXPECT_THAT(reason("Pf\n2 2\n-1\n" + std::string(reinterpret_cast<const char*>(notANumber), sizeof notANumber)),
                HasSubstr("a height is nan"));
    const float tooHigh[4] = {0, 1.5f, 0, 0};
    EXPECT_THAT(reason("Pf\n2 2\n-1\n" + std::string(reinterpret_cast<const char*>(tooHigh), sizeof tooHigh)),
                HasSubstr("allowed: 0..1"));
    folder_.write("few.pgm", "P5\n2 2\n255\nxxxx");
    folder_.write("mixed.toml", "description = \"r\"\nheights = \"heights.pgm\"\ncolours = \"few.pgm\"\n");
    EXPECT_THAT(inputError([&] { static_cast<void>(readRelief(folder_.path() / "mixed.toml")); }),
                HasSubstr("the colours have 2x2 texels, expected those of the heights, 3x2"));
}

// Two plates overlap if and only if some point of one is inside the other: checked with many points, which may miss a
// small common part.
TEST(Panels, OverlapIsThatOfTheirPoints) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(-1, 1);
    const auto any = [&] { return glm::dvec3(share(random), share(random), share(random)); };
    int together = 0, missed = 0;
    for (int n = 0; n < 300; ++n) {
        const auto make = [&] {
            scene::Panel panel;
            panel.toParent = glm::rotate(glm::translate(glm::dmat4(1), 0.8 * any()), 3 * share(random), any());
            panel.sizeMetres = glm::dvec2(0.6 + 0.5 * share(random), 0.6 + 0.5 * share(random));
            panel.depthMetres = 0.3 + 0.2 * share(random);
            return panel;
        };
        const scene::Panel a = make(), b = make();
        bool shared = false;
        for (int k = 0; k < 4000 && !shared; ++k) {
            const glm::dvec3 own(0.5 * a.sizeMetres.x * share(random), 0.5 * a.sizeMetres.y * share(random),
                                 -0.5 * a.depthMetres * (1 + share(random)));
            const glm::dvec3 there(glm::inverse(b.toParent) * a.toParent * glm::dvec4(own, 1));
            shared = std::abs(there.x) < b.sizeMetres.x / 2 && std::abs(there.y) < b.sizeMetres.y / 2 && there.z < 0 &&
                     there.z > -b.depthMetres;
        }
        if (shared) {
            EXPECT_TRUE(overlap(a, b)) << n;
        }
        EXPECT_EQ(overlap(a, b), overlap(b, a));
        together += shared ? 1 : 0;
        missed += overlap(a, b) && !shared ? 1 : 0;
    }
    EXPECT_GT(together, 50);
    EXPECT_LT(missed, 6);
}

}  // namespace
}  // namespace dustbench::world
