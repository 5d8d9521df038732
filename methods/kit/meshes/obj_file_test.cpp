#include "methods/kit/meshes/polygons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/kit/testing/test_input_error.h"

namespace dustbench::meshes {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string objRefusal(const std::string& text) {
    return inputError([&] { (void)readObj(text, "m.obj"); });
}

TEST(ObjFile, RefusesACornerWithAMissingPart) {
    const std::string all = corners + "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
    EXPECT_EQ(readObj(all + "f 1/1/1 2/2/1 3/3/1\n", "m.obj").size(), 1u);
    for (const char* corner : {"2/", "2//", "2/2/", "/2", "//", "2//1/", "2/2/1/1", "2/x", "2/2/x"})
        EXPECT_THAT(objRefusal(all + "f 1/1/1 " + corner + " 3/3/1\n"), HasSubstr("m.obj:8: ")) << corner;
    EXPECT_THAT(objRefusal(all + "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 2/ 3/3/1\n"), HasSubstr("m.obj:9: "));
    for (const char* face : {"f 1/ 2/ 3/\n", "f 1// 2// 3//\n", "f 1/1/ 2/2/ 3/3/\n"})
        EXPECT_THAT(objRefusal(all + face), HasSubstr("m.obj:8: ")) << face;
    EXPECT_THAT(objRefusal(all + "f 1/1/1 2 3/3/1\n"), HasSubstr("corners '1/1/1' and '2', expected one form for all"));
}

TEST(ObjFile, NamesTheLineAndWhatIsAllowed) {
    EXPECT_THAT(objRefusal(corners + "f 1 2 77\n"), HasSubstr("m.obj:4: a face refers to vertex '77', expected 1..3"));
    EXPECT_THAT(objRefusal(corners + "f 1 2 0\n"), HasSubstr("refers to vertex '0'"));
    EXPECT_THAT(objRefusal(corners + "f 1 2 -4\n"), HasSubstr("refers to vertex '-4'"));
    EXPECT_THAT(objRefusal(corners + "f 1//1 2//1 3//9\n"), HasSubstr("refers to normal '1', expected 1..0"));
    EXPECT_THAT(objRefusal("v 0 0 nan\n"), HasSubstr("m.obj:1: got 'nan', expected a number"));
    EXPECT_THAT(objRefusal("v 0 0 1e39\n"), HasSubstr("expected a number in the range of a float"));
    EXPECT_THAT(objRefusal("v 0 0\n"), HasSubstr("got 2 numbers after 'v', expected 3..7"));
    EXPECT_THAT(objRefusal(corners + "f 1 2\n"), HasSubstr("a face has 2 corners, allowed: 3..4096"));
    EXPECT_THAT(objRefusal(corners + "F 1 2 3\n"), HasSubstr("got 'F', expected v, vt, vn, f"));
    EXPECT_THAT(objRefusal(corners + "surf 0 1 0 1 1 2\n"), HasSubstr("got 'surf'"));
    EXPECT_THAT(objRefusal(corners), HasSubstr("has no faces"));
    EXPECT_THAT(objRefusal("f 1 2 3\n"), HasSubstr("expected 1..0"));
    EXPECT_THAT(objRefusal(corners + "f 1 2 3"), HasSubstr("the last line has no line end"));
    std::string many = corners + "f";
    for (int i = 0; i < 4097; ++i) many += " 1";
    EXPECT_THAT(objRefusal(many + "\n"), HasSubstr("a face has 4097 corners, allowed: 3..4096"));
}

TEST(ObjFile, HoldsTheFileToItsOwnCounts) {
    EXPECT_EQ(readObj("# counts: v 3, f 1\n" + corners + "f 1 2 3\n", "m.obj").size(), 1u);
    EXPECT_THAT(objRefusal("# counts: v 3, f 2\n" + corners + "f 1 2 3\n"), HasSubstr("has 1 lines 'f', expected 2"));
    EXPECT_THAT(objRefusal("# counts: v 4, f 1\n" + corners + "f 1 2 3\n"), HasSubstr("has 3 lines 'v', expected 4"));
    EXPECT_THAT(objRefusal("# counts: v x\n" + corners + "f 1 2 3\n"), HasSubstr("expected '# counts: v 642, f 1280'"));
}

TEST(ObjFile, ReadsWhatOtherProgramsWrite) {
    // Negative indices, continued lines, comments, weights and colours, Windows' line ends, groups and materials.
    const Polygons mesh = readObj(
        "mtllib a\\b.mtl\r\no thing\r\nv 0 0 0 1\r\nv +1 0 0 0.5 0.5 0.5\r\nv 0 1e0 0 # three\r\ng a b\r\n"
        "usemtl red\r\ns off\r\nf -3 \\\r\n -2 -1\r\nl 1 2\r\n# ends in \\\r\nf 3 2 1\r\n",
        "m.obj");
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 2, 1, 0));
    EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
    EXPECT_TRUE(mesh.normals.empty());
}

TEST(ObjFile, SplitsVerticesByNormalsAlone) {
    const Polygons mesh =
        readObj(corners + "vt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 0 -1\nf 1/1/1 2/1/1 3/1/1\nf 1/2/1 3/2/2 2/2/2\n", "m.obj");
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 0, 3, 4));
    ASSERT_EQ(mesh.normals.size(), 5u);
    EXPECT_EQ(mesh.positions[3], mesh.positions[2]);
    EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0, -1));
    EXPECT_TRUE(readObj(corners + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 2 3\n", "m.obj").normals.empty());
}

}  // namespace
}  // namespace dustbench::meshes
