#include "methods/kit/meshes/polygons.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "methods/kit/testing/test_input_error.h"

namespace dustbench::meshes {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string start = "ply\nformat ascii 1.0\n";
const std::string vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string end = "end_header\n";
const std::string points = "0 0 0\n1 0 0\n0 1 0\n";

std::string plyRefusal(const std::string& text) {
    return inputError([&] { (void)readPly(text, "m.ply"); });
}

Polygons read(const std::string& text) {
    return readPly(text, "m.ply");
}

/// The bytes of numbers, least significant first or last.
class Bytes {
 public:
    explicit Bytes(bool bigEndian) : bigEndian_(bigEndian) {}
    template <typename Number>
    Bytes& add(Number number) {
        std::string bytes(sizeof number, '\0');
        std::memcpy(bytes.data(), &number, sizeof number);
        if (bigEndian_) std::ranges::reverse(bytes);
        text += bytes;
        return *this;
    }
    std::string text;

 private:
    bool bigEndian_;
};

TEST(PlyFile, ReadsElementsInAnyOrder) {
    const Polygons faceFirst = read(start + face + vertex + end + "3 0 1 2\n" + points);
    EXPECT_THAT(faceFirst.corners, ElementsAre(0, 1, 2));
    EXPECT_EQ(faceFirst.positions[1], glm::vec3(1, 0, 0));
    const std::string edge = "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\n";
    EXPECT_THAT(read(start + vertex + edge + face + end + points + "0 1 9\n1 2 9\n3 0 1 2\n").corners,
                ElementsAre(0, 1, 2));
    EXPECT_THAT(read(start + edge + face + vertex + end + "0 1 9\n1 2 9\n3 0 1 2\n" + points).corners,
                ElementsAre(0, 1, 2));
    const std::string turned =
        "element vertex 3\nproperty list uchar int rings\nproperty double z\nproperty short x\nproperty int y\n";
    const Polygons mixed = read(start + turned + face + end + "0 0.5 1 2\n2 7 8 0.5 -3 4\n1 7 0.5 5 6\n3 2 1 0\n");
    EXPECT_EQ(mixed.positions[1], glm::vec3(-3, 4, 0.5f));
    EXPECT_THAT(mixed.corners, ElementsAre(2, 1, 0));
}

TEST(PlyFile, ReadsLongPolygonsWithAnyTypeOfCount) {
    for (const char* type : {"short", "ushort", "int", "uint"})
        for (const int n : {300, 2045, 2046, 2047, 4096}) {
            std::string text =
                start + fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n", n) +
                fmt::format("element face 1\nproperty list {} int vertex_index\n", type) + end;
            for (int k = 0; k < n; ++k)
                text += fmt::format("{} {} 0\n", std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n));
            text += fmt::format("{}", n);
            for (int k = 0; k < n; ++k) text += fmt::format(" {}", k);
            const Polygons mesh = read(text + "\n");
            ASSERT_EQ(mesh.size(), 1u);
            EXPECT_EQ(mesh[0].size(), static_cast<std::size_t>(n)) << type;
        }
    std::string tooMany = "4097";
    for (int i = 0; i < 4097; ++i) tooMany += " 0";
    EXPECT_THAT(plyRefusal(start + vertex + "element face 1\nproperty list int int vertex_indices\n" + end + points +
                           tooMany + "\n"),
                HasSubstr("a face has 4097 corners, allowed: 3..4096"));
}

TEST(PlyFile, ReadsBothOrdersOfBytes) {
    for (const bool big : {false, true}) {
        const std::string header = fmt::format(
            "ply\nformat binary_{}_endian 1.0\nelement vertex 3\nproperty double x\nproperty float y\n"
            "property short z\nproperty list ushort char names\nelement face 2\n"
            "property list int uint vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
            "end_header\n",
            big ? "big" : "little");
        Bytes body(big);
        for (int k = 0; k < 3; ++k) {
            body.add(0.5 * k).add(1.5f * static_cast<float>(k)).add(static_cast<std::int16_t>(-k));
            body.add(static_cast<std::uint16_t>(k));
            for (int i = 0; i < k; ++i) body.add(static_cast<std::int8_t>(i));
        }
        for (const std::uint32_t first : {0u, 1u}) {
            body.add(std::int32_t{3}).add(first).add(1 - first).add(2u);
            body.add(std::uint8_t{1}).add(std::uint8_t{2}).add(static_cast<std::uint8_t>(3 + first));
        }
        const std::string whole = header + body.text;
        const Polygons mesh = read(whole);
        EXPECT_EQ(mesh.positions[2], glm::vec3(1, 3, -2));
        EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 1, 0, 2));
        EXPECT_EQ(mesh.faceColours[1], (Colour8{1, 2, 4}));
        for (std::size_t size = 0; size < whole.size(); ++size) plyRefusal(whole.substr(0, size));
        EXPECT_THAT(plyRefusal(whole + "x"), HasSubstr("1 bytes follow the last element"));
    }
}

TEST(PlyFile, RefusesHeadersThatAnnounceNoMesh) {
    const std::string empty =
        "element vertex 0\nproperty float x\nproperty float y\nproperty float z\nelement face 0\nproperty list uchar "
        "int vertex_indices\n";
    EXPECT_THAT(plyRefusal(start + empty + end), HasSubstr("has no vertices"));
    EXPECT_THAT(plyRefusal(start + "element vertex 0\nelement face 0\n" + end), HasSubstr("has no vertices"));
    EXPECT_THAT(plyRefusal(start + face + end + "3 0 1 2\n"), HasSubstr("has no vertices"));
    EXPECT_THAT(plyRefusal(start + vertex + end + points), HasSubstr("has no faces"));
    EXPECT_THAT(plyRefusal(start + "element vertex 3\nproperty float y\nproperty float z\n" + face + end +
                           "0 0\n1 0\n0 1\n3 0 1 2\n"),
                HasSubstr("its vertices have no x, y and z"));
    EXPECT_THAT(plyRefusal(start + vertex + "element face 1\nproperty int vertex_indices\n" + end + points + "3\n"),
                HasSubstr("'vertex_indices' is not a list of integers"));
    EXPECT_THAT(plyRefusal(start + vertex + "element face 1\nproperty list uchar float vertex_indices\n" + end +
                           points + "3 0 1 2\n"),
                HasSubstr("is not a list of integers"));
    EXPECT_THAT(plyRefusal(start + vertex + "element face 1\nproperty uchar flags\n" + end + points + "3\n"),
                HasSubstr("have no list vertex_indices"));
    EXPECT_THAT(
        plyRefusal(start + "element vertex 3\nproperty list uchar float x\nproperty float y\nproperty float z\n" +
                   face + end + "1 0 0 0\n1 1 0 0\n1 0 1 0\n3 0 1 2\n"),
        HasSubstr("'x' is a list, expected one number"));
    EXPECT_THAT(plyRefusal("ply\nformat binary_little_endian 1.0\nelement vertex 3\nelement face 1\n" + end),
                HasSubstr("element 'vertex' has no properties"));
    EXPECT_THAT(plyRefusal("ply\nformat binary_little_endian 1.0\n" + vertex + face + "element rest 100000000\n" + end),
                HasSubstr("element 'rest' has no properties"));
    EXPECT_THAT(plyRefusal(start + vertex + vertex + face + end), HasSubstr("element 'vertex' occurs twice"));
    EXPECT_THAT(plyRefusal(start + vertex + "property float x\n" + face + end), HasSubstr("property 'x' occurs twice"));
    EXPECT_THAT(plyRefusal(start + "element vertex 100000001\n"), HasSubstr("elements 0..100000000"));
    EXPECT_THAT(plyRefusal(start + "element vertex -1\n"), HasSubstr("elements 0..100000000"));
    EXPECT_THAT(
        plyRefusal(start + vertex + "property float red\nproperty float green\nproperty float blue\n" + face + end),
        HasSubstr("property 'red' of its vertex elements is float, expected uchar"));
    EXPECT_THAT(plyRefusal(start + vertex), HasSubstr("no end"));
    EXPECT_THAT(plyRefusal("ply\n" + vertex + face + end), HasSubstr("no format"));
    EXPECT_THAT(plyRefusal("ply\nformat ascii 2.0\n"), HasSubstr("expected a format line"));
    EXPECT_THAT(plyRefusal(start + "element vertex 3\nproperty list float float x\n"),
                HasSubstr("one like uchar or int"));
}

TEST(PlyFile, RefusesBodiesThatHoldSomethingElse) {
    const std::string header = start + vertex + face + end;
    EXPECT_THAT(plyRefusal(header + "0 0 0\n1 0"), HasSubstr("m.ply:11: too few numbers for one vertex"));
    EXPECT_THAT(plyRefusal(header + points), HasSubstr("ends within its face elements"));
    EXPECT_THAT(plyRefusal(header + points + "3 0 1 8\n"), HasSubstr("face 0 uses vertex 8, expected 0..2"));
    EXPECT_THAT(plyRefusal(header + points + "3 0 1 -1\n"), HasSubstr("uses vertex -1"));
    EXPECT_THAT(plyRefusal(header + points + "3 0 1 1.5\n"), HasSubstr("got '1.5', expected a number of type int"));
    EXPECT_THAT(plyRefusal(header + points + "2 0 1\n"), HasSubstr("a face has 2 corners, allowed: 3..4096"));
    EXPECT_THAT(plyRefusal(header + points + "-3 0 1 2\n"), HasSubstr("got '-3', expected a number of type uchar"));
    EXPECT_THAT(plyRefusal(header + points + "3 0 1 2 0\n"), HasSubstr("too many numbers for one face"));
    EXPECT_THAT(plyRefusal(header + points + "3 0 1 2\n3 0 1 2\n"), HasSubstr("text after the last element"));
    EXPECT_THAT(plyRefusal(header + points + "3 0 1 2"), HasSubstr("the last line has no line end"));
    EXPECT_THAT(plyRefusal(header + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"), HasSubstr("not finite"));
    const std::string signedList = start + vertex + "element face 1\nproperty list int int vertex_indices\n" + end;
    EXPECT_THAT(plyRefusal(signedList + points + "-1\n"), HasSubstr("has a length of -1"));
}

TEST(PlyFile, SurvivesAnyChangeOfHeaderAndBody) {
    std::mt19937 random(28);
    Bytes body(false);
    for (int k = 0; k < 9; ++k) body.add(static_cast<float>(k));
    body.add(std::uint8_t{3}).add(0).add(1).add(2);
    const std::string binary = "ply\nformat binary_little_endian 1.0\n" + vertex + face + end + body.text;
    for (const std::string& whole : {start + vertex + face + end + points + "3 0 1 2\n", binary})
        for (int n = 0; n < 20'000; ++n) {
            std::string text = whole;
            for (auto k = random() % 4; k < 4; ++k) {
                const std::size_t at = random() % text.size(), length = 1 + random() % 12;
                if (random() % 3 == 0)
                    text[at] = static_cast<char>(random() % 256);
                else if (random() % 2 == 0)
                    text.erase(at, length);
                else
                    text.insert(at, text.substr(random() % text.size(), length));
            }
            try {
                const Polygons mesh = read(text);
                for (const std::uint32_t corner : mesh.corners) ASSERT_LT(corner, mesh.positions.size());
                ASSERT_EQ(mesh.ends.back(), mesh.corners.size());
            } catch (const InputError&) {
            }
        }
}

}  // namespace
}  // namespace dustbench::meshes
