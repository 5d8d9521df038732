#include "methods/kit/meshes/polygons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstring>

#include "methods/kit/testing/test_input_error.h"

namespace dustbench::meshes {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string stlRefusal(const std::string& text) {
    return inputError([&] { (void)readStl(text, "m.stl"); });
}

/// A binary file of `triangles` triangles with the corners 0, 1, 2 …
std::string binary(std::uint32_t triangles, const std::string& title = "") {
    std::string text = title + std::string(80 - title.size(), ' ');
    text.append(reinterpret_cast<const char*>(&triangles), 4);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        for (int k = 0; k < 12; ++k) {
            const float value = k < 3 ? 0 : static_cast<float>(i + static_cast<std::uint32_t>(k / 3) - 1);
            text.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
        text.append(2, '\0');
    }
    return text;
}

const std::string ascii =
    "solid a post\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex -0 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 1 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid a post\n";

TEST(StlFile, KeywordsMayBeInCapitals) {
    std::string capitals = ascii;
    for (char& letter : capitals) letter = static_cast<char>(std::toupper(letter));
    const Polygons mesh = readStl(capitals, "m.stl");
    EXPECT_EQ(mesh.size(), 2u);
    EXPECT_EQ(mesh.positions, readStl(ascii, "m.stl").positions);
    EXPECT_THAT(stlRefusal("SOLID MY PART\nFACET\n"), HasSubstr("expected 'facet normal X Y Z'"));
}

TEST(StlFile, RefusesABinaryFileOfAnotherLength) {
    const std::string whole = binary(32);
    ASSERT_EQ(whole.size(), 1684u);
    EXPECT_EQ(readStl(whole, "m.stl").size(), 32u);
    EXPECT_EQ(readStl(binary(32, "solid, but binary"), "m.stl").size(), 32u);
    EXPECT_THAT(stlRefusal(whole.substr(0, 1000)), HasSubstr("of 32 triangles has 1684 bytes, got 1000"));
    EXPECT_THAT(stlRefusal(whole + "\n"), HasSubstr("got 1685"));
    for (std::size_t size = 0; size < whole.size(); ++size) stlRefusal(whole.substr(0, size));
    const std::string titled = binary(3, "solid, but binary\n");
    for (std::size_t size = 0; size < titled.size(); ++size) stlRefusal(titled.substr(0, size));
    EXPECT_THAT(stlRefusal(binary(0)), HasSubstr("no triangles"));
}

TEST(StlFile, JoinsCornersAtOnePoint) {
    const Polygons mesh = readStl(ascii, "m.stl");
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 2, 1, 3));
}

TEST(StlFile, RefusesAnAsciiFileCutAtAnyByte) {
    for (std::size_t size = 0; size < ascii.size(); ++size) stlRefusal(ascii.substr(0, size));
    EXPECT_THAT(stlRefusal("solid a\nendsolid a\n"), HasSubstr("no triangles"));
    EXPECT_EQ(readStl(ascii + ascii, "m.stl").size(), 4u);
    EXPECT_THAT(stlRefusal(ascii + "facet\n"), HasSubstr("text after 'endsolid'"));
}

TEST(StlFile, NamesTheLineOfWhatIsWrong) {
    const auto with = [](const std::string& from, const std::string& to) {
        std::string text = ascii;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_THAT(stlRefusal(with("vertex 1 0 0", "vertex 1 0")), HasSubstr("m.stl:5: got 3 words, expected 4"));
    EXPECT_THAT(stlRefusal(with("vertex 1 0 0", "vertex 1 0 nan")), HasSubstr("m.stl:5: got 'nan'"));
    EXPECT_THAT(stlRefusal(with("endloop", "vertex 1 1 1\nendloop")), HasSubstr("expected 'endloop'"));
    EXPECT_THAT(stlRefusal(with("endsolid a post", "endsolid a pos")), HasSubstr("'endsolid' with the solid's name"));
    std::string notFinite = binary(1);
    const float nan = NAN;
    std::memcpy(notFinite.data() + 96, &nan, sizeof nan);
    EXPECT_THAT(stlRefusal(notFinite), HasSubstr("triangle 1 has a corner that is not a finite point"));
}

}  // namespace
}  // namespace dustbench::meshes
