#include "methods/kit/meshes/mesh_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/maths/srgb.h"
#include "methods/kit/meshes/polygons.h"
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

/// Why readMesh refuses the file: one line that names it, and nothing on standard error.
std::string refusal(const std::filesystem::path& file) {
    ::testing::internal::CaptureStderr();
    std::string text = inputError([&] { static_cast<void>(readMesh(file, {})); });
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << file;
    EXPECT_THAT(text, HasSubstr(file.string()));
    return text;
}

std::string tetrahedronObj() {
    return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

TEST(MeshFile, WhatNobodyUsesIsNoted) {
    const TestFolder folder;
    const auto ignoredOf = [&](const std::string& name, const std::string& text) {
        const auto file = folder.write(name, text);
        const files::InputLog log;
        (void)readMesh(file, {});
        const auto ignored = log.ignored();
        return ignored.contains(file) ? ignored.at(file) : std::vector<std::string>();
    };
    using ::testing::ElementsAre;
    EXPECT_THAT(ignoredOf("a.obj", tetrahedronObj()), ElementsAre());
    // As Blender writes it.
    EXPECT_THAT(ignoredOf("b.obj",
                          "# Blender 3.6\nmtllib b.mtl\no Cube\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nvt 0 0\n"
                          "s 1\nusemtl Red\nf 1/1 2/1 3/1\nl 1 2\n"),
                ElementsAre("colours of vertices (v x y z r g b)", "lines and points (l, p)",
                            "materials (mtllib, usemtl)", "smoothing groups (s)", "texture coordinates (vt)"));
    EXPECT_THAT(
        ignoredOf("a.ply",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
                  "z\nproperty float s\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty "
                  "uchar alpha\nelement face 1\nproperty list uchar int vertex_indices\nelement edge 1\nproperty "
                  "int vertex1\nend_header\n0 0 0 9 255 0 0 255\n1 0 0 9 255 0 0 255\n0 1 0 9 255 0 0 255\n"
                  "3 0 1 2\n0\n"),
        ElementsAre("property 's' of vertex", "property 'alpha' of vertex", "element 'edge'"));
    std::string stl(84 + 50, '\0');
    stl[80] = 1;
    const float corners[]{0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::memcpy(&stl[84 + 12], corners, sizeof corners);
    EXPECT_THAT(ignoredOf("a.stl", stl), ElementsAre());
    stl[84 + 48] = 31;  // red, where some programs store it
    EXPECT_THAT(ignoredOf("b.stl", stl), ElementsAre("attributes of triangles, such as colours"));
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

TEST(MeshFile, ShippedMeshesHaveTheVerticesAndTrianglesThatVtkReads) {
    struct Counts {
        const char* file;
        std::size_t vertices, triangles;  ///< vertices after creases are split
    };
    for (const auto& [file, vertices, triangles] :
         {Counts{"scenes/meshes/crate.ply", 432, 216}, Counts{"scenes/meshes/wall.ply", 1188, 594},
          Counts{"shapes/meshes/figure.ply", 4390, 5624}, Counts{"shapes/meshes/hare.ply", 4280, 7200},
          Counts{"shapes/meshes/helicopter.ply", 1974, 3132}, Counts{"scenes/meshes/rock.obj", 212, 320},
          Counts{"scenes/meshes/sphere.obj", 2562, 5120}, Counts{"scenes/meshes/marker_post.stl", 48, 32}}) {
        const scene::Mesh mesh = readMesh(files::dataFolder() / file, {});
        EXPECT_EQ(mesh.positions.size(), vertices) << file;
        EXPECT_EQ(mesh.indices.size(), 3 * triangles) << file;
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
    EXPECT_THAT(refusal(folder.path() / "none.obj"), HasSubstr("cannot be read: No such file"));
    EXPECT_THAT(refusal(folder.write("a.fbx", "x")), HasSubstr("expected .obj, .ply or .stl"));
    for (const char* name : {"empty.obj", "empty.ply", "empty.stl"}) refusal(folder.write(name, ""));
    for (const char* name : {"rubbish.obj", "rubbish.ply", "rubbish.stl"})
        refusal(folder.write(name, "this is not\na mesh at all\n"));
    std::filesystem::create_directory(folder.path() / "folder.stl");
    EXPECT_THAT(refusal(folder.path() / "folder.stl"), HasSubstr("is a folder"));
    const auto pipe = folder.path() / "pipe.ply";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(refusal(pipe), HasSubstr("is a pipe, allowed: regular files only"));
    std::filesystem::create_symlink("/dev/zero", folder.path() / "zero.stl");
    EXPECT_THAT(refusal(folder.path() / "zero.stl"), HasSubstr("is a device"));
    const auto sparse = folder.write("sparse.stl", "x");
    std::filesystem::resize_file(sparse, std::uintmax_t{1} << 40);
    EXPECT_THAT(refusal(sparse), HasSubstr("allowed: 1000 MB"));
}

/// All meshes delivered with the program.
std::vector<std::filesystem::path> shippedMeshes() {
    std::vector<std::filesystem::path> meshes;
    for (const char* folder : {"scenes", "shapes"})
        for (const auto& entry : std::filesystem::directory_iterator(files::dataFolder() / folder / "meshes"))
            if (const auto kind = entry.path().extension(); kind == ".obj" || kind == ".ply" || kind == ".stl")
                meshes.push_back(entry.path());
    return meshes;
}

/// Reads the text as a file with this extension.
Polygons polygonsOf(const std::filesystem::path& file, std::string_view text) {
    if (file.extension() == ".obj") return readObj(text, file);
    return file.extension() == ".ply" ? readPly(text, file) : readStl(text, file);
}

TEST(MeshFile, RefusesEveryShippedMeshCutAtAnyByte) {
    ASSERT_GE(shippedMeshes().size(), 8u);
    for (const auto& file : shippedMeshes()) {
        const std::string whole = files::wholeText(file, "a mesh");
        ASSERT_GT(polygonsOf(file, whole).size(), 0u) << file;
        // Every byte of a short file. A long one is read from its start each time, so its first and last 300 bytes, and
        // 100 places between.
        const std::size_t step = whole.size() < 16'000 ? 1 : whole.size() / 100, ends = 300;
        for (std::size_t size = 0; size < whole.size();) {
            EXPECT_THROW(polygonsOf(file, std::string_view(whole).substr(0, size)), InputError) << file << " " << size;
            size += size < ends || size + ends > whole.size() ? 1 : step;
        }
    }
}

TEST(MeshFile, GivesNMinusTwoTrianglesForAnyPolygon) {
    const TestFolder folder;
    std::mt19937 random(28);
    std::uniform_real_distribution<double> length(0.2, 1), height(-1e-3, 1e-3);
    for (const int n : {3, 4, 5, 8, 17, 300, 3000}) {
        // A star about the origin: concave, and its area is known.
        std::string corners, face = "f";
        double area = 0, previous = 0, first = 0;
        for (int k = 0; k < n; ++k) {
            const double radius = length(random), angle = 2 * M_PI * k / n;
            corners += fmt::format("v {} {} 0\n", radius * std::cos(angle), radius * std::sin(angle));
            face += fmt::format(" {}", k + 1);
            if (k > 0) area += 0.5 * previous * radius * std::sin(2 * M_PI / n);
            if (k == 0) first = radius;
            previous = radius;
        }
        area += 0.5 * previous * first * std::sin(2 * M_PI / n);
        const scene::Mesh mesh = readMesh(folder.write("star.obj", corners + face + "\n"), {});
        EXPECT_EQ(mesh.indices.size(), 3u * static_cast<std::size_t>(n - 2)) << n;
        double sum = 0;
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]),
                c(mesh.positions[mesh.indices[i + 2]]);
            const double part = 0.5 * glm::cross(b - a, c - a).z;
            EXPECT_GE(part, -1e-9) << n;  // none is outside
            sum += part;
        }
        EXPECT_NEAR(sum, area, 1e-5) << n;
    }
    // Without area, or self-intersecting: still n - 2.
    const auto triangles = [&](const std::string& text) {
        return readMesh(folder.write("p.obj", text), {}).indices.size() / 3;
    };
    EXPECT_EQ(triangles("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nf 1 2 3 4 5\n"), 3u);
    EXPECT_EQ(triangles("v 0 0 0\nf 1 1 1 1 1 1\n"), 4u);
    EXPECT_EQ(triangles("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n"), 2u);
    EXPECT_EQ(triangles("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e38 1e38 1e38\nv -1e38 5 7\nf 1 2 3 4 5\n"), 3u);
}

TEST(MeshFile, SurvivesAnyDamageToAFile) {
    const TestFolder folder;
    std::mt19937 random(5);
    for (const char* name : {"rock.obj", "crate.ply", "marker_post.stl"}) {
        const std::string whole = files::wholeText(files::dataFolder() / "scenes" / "meshes" / name, "a mesh");
        for (int n = 0; n < 60; ++n) {
            std::string text = whole;
            for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random() % 256);
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
