#include "methods/kit/meshes/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/maths/srgb.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::meshes {
namespace {

using ::testing::HasSubstr;

/// Six times the volume of a closed mesh; positive if its triangles face outwards.
double volume(const scene::Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
            c(mesh.positions[mesh.indices[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

std::string tetrahedronObj() {
    return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

TEST(MeshFile, ReadsEveryFormatOfTheBuiltInSolids) {
    const auto folder = files::dataFolder() / "scenes" / "meshes";
    for (const char* name : {"rock.obj", "crate.ply", "marker_post.stl"}) {
        const scene::Mesh mesh = readMesh(folder / name, {0.5f, 0.25f, 0.125f});
        EXPECT_GT(mesh.indices.size(), 0u) << name;
        EXPECT_EQ(mesh.indices.size() % 3, 0u) << name;
        EXPECT_EQ(mesh.normals.size(), mesh.positions.size()) << name;
        EXPECT_EQ(mesh.colours.size(), mesh.positions.size()) << name;
        EXPECT_LT(*std::ranges::max_element(mesh.indices), mesh.positions.size()) << name;
        for (const glm::vec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-4) << name;
        EXPECT_GT(volume(mesh), 0) << name;
    }
}

TEST(MeshFile, ComputesOutwardNormalsWhereTheFileHasNone) {
    const TestFolder folder;
    const scene::Mesh mesh = readMesh(folder.write("t.obj", tetrahedronObj()), {1, 0, 0});
    ASSERT_EQ(mesh.indices.size(), 12u);
    EXPECT_NEAR(volume(mesh), 1.0 / 6, 1e-6);
    for (std::size_t i = 0; i < 12; i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                        c = mesh.positions[mesh.indices[i + 2]];
        const glm::vec3 facet = glm::normalize(glm::cross(b - a, c - a));
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(glm::dot(mesh.normals[mesh.indices[i + k]], facet), 1, 1e-5);  // its edges are creases
    }
    EXPECT_EQ(mesh.colours.front(), glm::vec3(1, 0, 0));
}

TEST(MeshFile, MakesVertexColoursOfPlyLinear) {
    const TestFolder folder;
    const auto file = folder.write("t.ply",
                                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                   "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                                   "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                   "0 0 0 255 128 0\n1 0 0 255 128 0\n0 1 0 255 128 0\n3 0 1 2\n");
    const scene::Mesh mesh = readMesh(file, {0, 0, 1});
    ASSERT_EQ(mesh.colours.size(), 3u);
    EXPECT_FLOAT_EQ(mesh.colours[0].r, 1);
    EXPECT_FLOAT_EQ(mesh.colours[0].g, maths::decodeSrgb(128.0f / 255));
    EXPECT_EQ(mesh.colours[0].b, 0);
}

TEST(MeshFile, FacesOfPlyKeepColoursOfTheirOwn) {
    const TestFolder folder;
    const auto file = folder.write("faces.ply",
                                   "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                   "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                                   "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
                                   "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 0 128\n");
    const scene::Mesh mesh = readMesh(file, {0, 1, 0});
    ASSERT_EQ(mesh.indices.size(), 6u);
    for (std::size_t corner = 0; corner < 6; ++corner) {
        const glm::vec3& colour = mesh.colours[mesh.indices[corner]];
        EXPECT_EQ(colour, corner < 3 ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, maths::decodeSrgb(128.0f / 255)));
    }
    EXPECT_EQ(mesh.positions[mesh.indices[5]], glm::vec3(0, 1, 0));
}

TEST(MeshFile, SaysInOneLineWhyAMeshCannotBeRead) {
    const TestFolder folder;
    const auto message = [&](const std::filesystem::path& file) {
        ::testing::internal::CaptureStderr();
        std::string text = inputError([&] { static_cast<void>(readMesh(file, {})); });
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << file;
        EXPECT_THAT(text, HasSubstr(file.string()));
        return text;
    };
    EXPECT_THAT(message(folder.path() / "none.obj"), HasSubstr("cannot be read"));
    EXPECT_THAT(message(folder.write("a.fbx", "x")), HasSubstr("expected .obj, .ply or .stl"));
    for (const char* name : {"empty.obj", "empty.ply", "empty.stl"}) message(folder.write(name, ""));
    for (const char* name : {"rubbish.obj", "rubbish.ply", "rubbish.stl"})
        message(folder.write(name, "this is not\na mesh at all\n"));
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_THAT(message(folder.write("bad.obj", corners + "f 1 2 77\n")),
                HasSubstr("bad.obj:4: a face names vertex '77', expected 1..3"));
    EXPECT_THAT(message(folder.write("bad.obj", corners + "f 1//1 2//1 3//9\n")), HasSubstr("names normal"));
    EXPECT_THAT(message(folder.write("bad.obj", "v 0 0 nan\n")), HasSubstr("bad.obj:1: got 'nan', expected a number"));
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_THAT(message(folder.write("a.ply", header)), HasSubstr("no end"));
    EXPECT_THAT(message(folder.write("a.ply", header + face + "0 0 0\n1 0")),
                HasSubstr("a.ply:11: too few numbers for one vertex"));
    EXPECT_THAT(message(folder.write("a.ply", header + face + "0 0 0\n1 0 0\n0 1 0\n")),
                HasSubstr("ends within its face elements"));
    EXPECT_THAT(message(folder.write("a.ply", header + face + "0 0 0\n1 0 0\n0 1 0\n3 0 1 8\n")),
                HasSubstr("uses vertex 9"));
    EXPECT_THAT(
        message(folder.write(
            "a.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nend_header\nabc")),
        HasSubstr("ends within its vertex elements"));
    // A binary STL of one triangle: normal, three corners, attribute.
    std::string stl(80, ' ');
    stl += std::string("\x01\0\0\0", 4);
    for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, NAN, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
        stl.append(reinterpret_cast<const char*>(&value), sizeof value);
    EXPECT_THAT(message(folder.write("nan.stl", stl + std::string(2, '\0'))), HasSubstr("not a finite point"));
    std::filesystem::create_directory(folder.path() / "folder.stl");
    message(folder.path() / "folder.stl");
}

TEST(MeshFile, SurvivesAnyDamageToAFile) {
    const TestFolder folder;
    std::mt19937 random(5);
    for (const char* name : {"rock.obj", "crate.ply", "marker_post.stl"}) {
        std::ifstream stream(files::dataFolder() / "scenes" / "meshes" / name, std::ios::binary);
        const std::string whole{std::istreambuf_iterator<char>(stream), {}};
        for (int n = 0; n < 60; ++n) {
            std::string text = whole;
            for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random() % 128);
            if (n % 3 == 0) text.resize(random() % text.size());
            const auto file = folder.write(name, text);
            try {
                const scene::Mesh mesh = readMesh(file, {});
                for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size());
            } catch (const InputError& error) {
                ASSERT_THAT(error.what(), HasSubstr(file.string()));
            }
        }
    }
}

}  // namespace
}  // namespace dustbench::meshes
