#include "bench/scene/solid_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/scene/scene_file.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::bench {
namespace {

using ::testing::HasSubstr;

constexpr const char* tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// A scene with one solid, and the meshes for it.
class OneSolid {
 public:
    OneSolid() {
        folder_.write("rest.obj", tetrahedron);
        folder_.write("taller.obj", "v 0 0 0\nv 1 0 0\nv 0 3 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        folder_.write("wider.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        folder_.write("fewer.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        folder_.write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n");
    }
    SceneFile with(const std::string& more) {
        return readScene(folder_.write(
            "s.toml", "description = \"\"\n[[solid]]\nname = \"it\"\nmesh = \"rest.obj\"\n" + more + "\n"));
    }
    std::string refusal(const std::string& more) {
        const std::string text = inputError([&] { (void)with(more); });
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        EXPECT_THAT(text, HasSubstr("s.toml:"));
        return text;
    }

 private:
    TestFolder folder_;
};

TEST(SolidTable, KeysMakeASolidMoveFromWhereItsTableHasIt) {
    OneSolid one;
    const SceneFile file = one.with(
        "position = [1, 2, 3]\nrotation_degrees = [0, 90, 0]\nscale = 2\n"
        "[[solid.key]]\ntime_seconds = 1\n[[solid.key]]\ntime_seconds = 3\nposition = [1, 6, 3]\n");
    ASSERT_EQ(file.scene.solids.size(), 1u);
    EXPECT_EQ(file.scene.solids[0].motion, scene::SolidMotion::moves);
    EXPECT_EQ(glm::vec3(file.scene.solidPoses[0].toWorld[3]), glm::vec3(1, 2, 3));
    const auto now = file.movingSolids.at(file.scene, 2);
    ASSERT_EQ(now.size(), 1u);
    EXPECT_EQ(glm::vec3(now[0].pose.toWorld[3]), glm::vec3(1, 4, 3));
    EXPECT_FLOAT_EQ(now[0].pose.velocity.y, 3);  // 1.5 times the mean: it starts and ends at rest
    EXPECT_LT(glm::distance(glm::vec3(now[0].pose.toWorld[0]), glm::vec3(0, 0, -2)), 1e-6f);
    EXPECT_EQ(now[0].shape, nullptr);
    // Without keys nothing moves, so moments have no solids.
    const SceneFile still = one.with("");
    EXPECT_FALSE(scene::anySolidMoves(still.scene));
    EXPECT_TRUE(still.movingSolids.at(still.scene, 2).empty());
}

TEST(SolidTable, TargetsDeformAndTheirVerticesHaveVelocities) {
    OneSolid one;
    const SceneFile file = one.with(
        "targets = [\"taller.obj\", \"wider.obj\"]\nkeys_repeat = true\n"
        "[[solid.key]]\ntime_seconds = 0\n[[solid.key]]\ntime_seconds = 1\nweights = [1, 0.5]\n"
        "[[solid.key]]\ntime_seconds = 2\n");
    EXPECT_EQ(file.scene.solids[0].motion, scene::SolidMotion::deforms);
    EXPECT_EQ(file.files.size(), 4u);  // including the scene file
    const auto highest = [](const scene::Mesh& mesh) {
        glm::vec3 corner(0);
        for (const glm::vec3& position : mesh.positions) corner = glm::max(corner, position);
        return corner;
    };
    EXPECT_EQ(highest(*file.scene.solids[0].mesh), glm::vec3(1, 1, 1));
    EXPECT_EQ(highest(file.movingSolids.at(file.scene, 1)[0].shape->mesh), glm::vec3(1.5f, 3, 1));
    // Velocities of vertices are the derivatives of their positions.
    constexpr double h = 1e-3;
    const auto before = file.movingSolids.at(file.scene, 0.4 - h), now = file.movingSolids.at(file.scene, 0.4),
               after = file.movingSolids.at(file.scene, 0.4 + h);
    float fastest = 0;
    for (std::size_t v = 0; v < now[0].shape->velocities.size(); ++v) {
        const glm::vec3 way = after[0].shape->mesh.positions[v] - before[0].shape->mesh.positions[v];
        const glm::vec3 velocity = now[0].shape->velocities[v];
        EXPECT_LT(glm::distance(way / static_cast<float>(2 * h), velocity), 1e-3f);
        fastest = std::max(fastest, glm::length(velocity));
        EXPECT_NEAR(glm::length(now[0].shape->mesh.normals[v]), 1, 1e-5);
    }
    EXPECT_GT(fastest, 2);
}

TEST(SolidTable, KeysStandOnTheGroundUnlessToldOtherwise) {
    const TestFolder folder;
    const auto dunes = [&](const std::string& more) {
        const SceneFile read = readScene(folder.write(
            "d.toml", "description = \"\"\n[terrain]\nkind = \"height_field\"\nimage = \"" +
                          (files::dataFolder() / "scenes/heights/dunes.png").string() +
                          "\"\nspacing_metres = 3\nheight_metres = 12\nbase_metres = -6\n[[solid]]\nname = \"it\"\n"
                          "mesh = \"meshes/rock.obj\"\nposition = [33, 1, 21]\n" +
                          more));
        const float ground = read.scene.terrain.heightAt(33, 21);
        return read.scene.solidPoses[0].toWorld[3].y - 1 - ground;
    };
    EXPECT_NEAR(dunes("[[solid.key]]\ntime_seconds = 0\n"), 0, 1e-5);
    EXPECT_GT(std::abs(dunes("on_ground = false\n[[solid.key]]\ntime_seconds = 0\n")), 0.01f);
}

TEST(SolidTable, SaysInOneLineWhatIsWrong) {
    OneSolid one;
    const std::string key = "[[solid.key]]\ntime_seconds = 1\n", next = "[[solid.key]]\ntime_seconds = 2\n";
    EXPECT_THAT(one.refusal(key + key), HasSubstr("key 'time_seconds': got 1, expected more than 1 (previous key)"));
    EXPECT_THAT(one.refusal("[[solid.key]]\nposition = [0, 0, 0]\n"), HasSubstr("time_seconds"));
    EXPECT_THAT(one.refusal(key + "speed = 3\n"), HasSubstr("speed"));
    EXPECT_THAT(one.refusal(key + "position = [0, 1e6, 0]\n"), HasSubstr("three numbers -100000..100000"));
    EXPECT_THAT(one.refusal(key + "rotation_degrees = [nan, 0, 0]\n"), HasSubstr("rotation_degrees"));
    EXPECT_THAT(one.refusal("repeat = 3\n" + key), HasSubstr("got 3 for a solid with keys, expected 1"));
    EXPECT_THAT(one.refusal("keys_repeat = true\n"), HasSubstr("got 0 keys, expected two or more"));
    EXPECT_THAT(one.refusal("keys_repeat = true\n" + key), HasSubstr("got 1 keys, expected two or more"));
    EXPECT_THAT(one.refusal("keys_repeat = true\n" + key + next + "position = [1, 0, 0]\n"),
                HasSubstr("the last key has a different position from the first"));
    EXPECT_THAT(one.refusal("keys_repeat = true\n" + key + next + "rotation_degrees = [0, 350, 0]\n"),
                HasSubstr("a different rotation from the first"));
    EXPECT_NO_THROW((void)one.with("keys_repeat = true\n" + key + next + "rotation_degrees = [0, 720, 0]\n"));
    EXPECT_THAT(one.refusal(key + "weights = [1]\n"), HasSubstr("got 1 numbers, expected 0"));
    EXPECT_THAT(one.refusal("targets = [\"taller.obj\"]\n" + key + "weights = [1, 1]\n"),
                HasSubstr("got 2 numbers, expected 1"));
    EXPECT_THAT(one.refusal("targets = [\"taller.obj\"]\n" + key + "weights = [1000]\n"), HasSubstr("-100..100"));
    EXPECT_THAT(one.refusal("targets = [\"taller.obj\"]\n"), HasSubstr("expected [[solid.key]] tables"));
    EXPECT_THAT(one.refusal("targets = [\"none.obj\"]\n" + key), HasSubstr("none.obj"));
    EXPECT_THAT(one.refusal("targets = [\"fewer.obj\"]\n" + key),
                HasSubstr("fewer.obj: got 3 points and 1 faces, expected 4 and 4"));
    EXPECT_THAT(one.refusal("targets = [\"other.obj\"]\n" + key), HasSubstr("face 4 has different corners"));
}

}  // namespace
}  // namespace dustbench::bench
