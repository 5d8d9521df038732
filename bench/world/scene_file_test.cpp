#include "bench/world/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "bench/world/data_list.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::world {
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

SceneFile builtInScene(const std::string& id) {
    return readScene(files::findData("scene", "scenes", id, ".toml"));
}

TEST(SceneFile, ReadsTheBuiltInScenes) {
    const SceneFile plain = builtInScene("plain");
    EXPECT_TRUE(plain.scene.terrain.isFlat());
    EXPECT_EQ(plain.scene.id, "plain");
    EXPECT_EQ(plain.drive, "straight");
    EXPECT_GE(plain.scene.solids.size(), 5u);
    EXPECT_EQ(plain.scene.solids.size(), plain.scene.solidPoses.size());
    EXPECT_TRUE(plain.scene.vehicle.has_value());
    const SceneFile dunes = builtInScene("dunes");
    EXPECT_EQ(dunes.scene.terrain.columns(), 257);
    EXPECT_EQ(dunes.scene.terrain.rows(), 257);
}

/// Volume enclosed by a closed surface, by the flux of (x, 0, 0), (0, y, 0) and (0, 0, z) through it.
glm::dvec3 volumes(const scene::Mesh& mesh) {
    glm::dvec3 sum(0);
    for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[k]]), b(mesh.positions[mesh.indices[k + 1]]),
            c(mesh.positions[mesh.indices[k + 2]]);
        sum += (a + b + c) / 3.0 * glm::cross(b - a, c - a) / 2.0;
    }
    return sum;
}

TEST(SceneFile, MeshesLieBesideTheFileElseAmongTheData) {
    const TestFolder folder;
    const auto meshOf = [&](const std::string& mesh) {
        return readScene(folder.write("mine.toml",
                                      "description = \"\"\n[[solid]]\nname = \"stone\"\nmesh = \"" + mesh + "\"\n"))
            .files.back();
    };
    EXPECT_EQ(meshOf("meshes/rock.obj"), files::dataFolder() / "scenes/meshes/rock.obj");
    std::filesystem::create_directories(folder.path() / "meshes");
    std::filesystem::copy_file(files::dataFolder() / "scenes/meshes/crate.ply", folder.path() / "meshes/rock.obj.ply");
    EXPECT_EQ(meshOf("meshes/rock.obj.ply"), folder.path() / "meshes/rock.obj.ply");
    EXPECT_THAT(
        inputError([&] { (void)meshOf("meshes/rok.obj"); }),
        testing::AllOf(HasSubstr("mine.toml:4"), HasSubstr("tried " + (folder.path() / "meshes/rok.obj").string()),
                       HasSubstr((files::dataFolder() / "scenes/meshes/rok.obj").string())));
}

TEST(SceneFile, SolidsOfTheBuiltInScenesAreClosedAndWoundAsSeenFromOutside) {
    int solids = 0;
    for (const std::string& id : files::listData("scenes", ".toml"))
        for (const scene::Solid& solid : builtInScene(id).scene.solids) {
            const glm::dvec3 volume = volumes(*solid.mesh);
            EXPECT_GT(volume.x, 0) << id << ' ' << solid.name;
            EXPECT_NEAR(volume.y / volume.x, 1, 1e-3) << id << ' ' << solid.name;
            EXPECT_NEAR(volume.z / volume.x, 1, 1e-3) << id << ' ' << solid.name;
            ++solids;
        }
    EXPECT_GE(solids, 7);
}

TEST(SceneFile, ManualShowsTheDefaults) {
    const TestFolder folder;
    const SceneFile bare = readScene(folder.write("bare.toml", "description = \"bare\"\n"));
    const SceneFile manual = builtInScene("plain");
    const scene::VehicleParameters a = bare.scene.vehicle->parameters, b = manual.scene.vehicle->parameters;
    EXPECT_NEAR(a.steerLimit, b.steerLimit, 1e-5);
    EXPECT_NEAR(a.steerRateLimit, b.steerRateLimit, 1e-5);
    EXPECT_EQ(a.wheelbaseMetres, b.wheelbaseMetres);
    EXPECT_EQ(a.trackMetres, b.trackMetres);
    EXPECT_EQ(a.wheelRadiusMetres, b.wheelRadiusMetres);
    EXPECT_EQ(a.wheelWidthMetres, b.wheelWidthMetres);
    EXPECT_EQ(a.massKilograms, b.massKilograms);
    EXPECT_EQ(a.lateralAccelerationLimit, b.lateralAccelerationLimit);
    EXPECT_EQ(a.driveAccelerationLimit, b.driveAccelerationLimit);
    EXPECT_EQ(a.drivePowerWatts, b.drivePowerWatts);
    EXPECT_EQ(a.brakeDecelerationLimit, b.brakeDecelerationLimit);
    EXPECT_EQ(a.dragAreaSquareMetres, b.dragAreaSquareMetres);
    EXPECT_EQ(a.rollingResistance, b.rollingResistance);
    EXPECT_EQ(a.topSpeed, b.topSpeed);
    EXPECT_EQ(bare.cameras.chase.offset, manual.cameras.chase.offset);
    EXPECT_EQ(bare.cameras.chase.lookAt, manual.cameras.chase.lookAt);
    EXPECT_EQ(bare.cameras.orbit.lookAt, manual.cameras.orbit.lookAt);
    EXPECT_NEAR(bare.cameras.chase.verticalFieldOfView, manual.cameras.chase.verticalFieldOfView, 1e-5);
    EXPECT_NEAR(bare.cameras.orbit.turnRate, manual.cameras.orbit.turnRate, 1e-5);
    EXPECT_NEAR(bare.cameras.orbit.startAngle, manual.cameras.orbit.startAngle, 1e-5);
    EXPECT_LT(glm::distance(bare.scene.lights.toSun, manual.scene.lights.toSun), 0.02f);
    EXPECT_EQ(bare.scene.lights.ambient, manual.scene.lights.ambient);
    EXPECT_EQ(bare.scene.dustAlbedo, manual.scene.dustAlbedo);
    EXPECT_EQ(bare.drive, manual.drive);
    EXPECT_EQ(bare.dust, manual.dust);
    EXPECT_EQ(bare.isDrawn, manual.isDrawn);
}

TEST(SceneFile, SunStandsWhereItsAnglesSay) {
    constexpr double right = std::numbers::pi / 2;
    EXPECT_LT(glm::distance(sunDirection(0, 0), glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(sunDirection(0, right), glm::vec3(0, 0, -1)), 1e-6f);
    EXPECT_LT(glm::distance(sunDirection(right, 1), glm::vec3(0, 1, 0)), 1e-6f);
}

TEST(SceneFile, DunesAreDrivableAndLevelAtTheRim) {
    const scene::Terrain& terrain = builtInScene("dunes").scene.terrain;
    float steepest = 0, highest = 0;
    for (float x = -400; x <= 400; x += 1.3f)
        for (float z = -400; z <= 400; z += 1.7f) {
            steepest = std::max(steepest, std::acos(std::min(1.0f, terrain.normalAt(x, z).y)));
            highest = std::max(highest, terrain.heightAt(x, z));
        }
    EXPECT_LT(steepest, 0.3f);
    EXPECT_GT(steepest, 0.1f);
    EXPECT_GT(highest, 1.5f);
    for (float along = -384; along <= 384; along += 3) {
        EXPECT_NEAR(terrain.heightAt(along, 384), 0, 1e-3);
        EXPECT_NEAR(terrain.heightAt(-384, along), 0, 1e-3);
    }
}

TEST(SceneFile, RepeatsASolidAlongItsStepAndKeepsItOnTheGround) {
    const TestFolder folder;
    folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const std::string head =
        "description = \"d\"\n[[solid]]\nname = \"s\"\nmesh = \"t.obj\"\nposition = [1, 2, 3]\nscale = 2\n";
    const SceneFile one = readScene(folder.write("one.toml", head));
    EXPECT_EQ(glm::vec3(one.scene.solidPoses[0].toWorld * glm::vec4(0, 1, 0, 1)), glm::vec3(1, 4, 3));
    const SceneFile three = readScene(folder.write("three.toml", head + "repeat = 3\nrepeat_step = [10, 0, 0]\n"));
    ASSERT_EQ(three.scene.solids.size(), 1u);
    EXPECT_EQ(three.scene.solids[0].mesh->indices.size(), 3 * one.scene.solids[0].mesh->indices.size());
    const auto& positions = three.scene.solids[0].mesh->positions;
    const auto last = std::ranges::max_element(positions, {}, [](const glm::vec3& p) { return p.x; });
    EXPECT_FLOAT_EQ(last->x, 1 + 20 + 2);
}

TEST(SceneFile, TurnsASolidAboutXThenZThenY) {
    const TestFolder folder;
    folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const SceneFile file = readScene(folder.write(
        "s.toml", "description=\"d\"\n[[solid]]\nname=\"s\"\nmesh=\"t.obj\"\nrotation_degrees=[90,90,0]\n"));
    // Y → Z by the rotation about X, then Z → X by the rotation about Y.
    const glm::vec3 turned(file.scene.solidPoses[0].toWorld * glm::vec4(0, 1, 0, 0));
    EXPECT_LT(glm::distance(turned, glm::vec3(1, 0, 0)), 1e-6f);
}

TEST(SceneFile, SaysFileLineAndWhatWasExpectedOfBadInput) {
    const TestFolder folder;
    folder.write("bad.obj", "nothing here");
    folder.write("bad.png", "no picture");
    const auto message = [&](const std::string& text) {
        const auto file = folder.write("s.toml", text);
        const std::string line = inputError([&] { static_cast<void>(readScene(file)); });
        EXPECT_THAT(line, HasSubstr(file.string() + ":"));
        return line;
    };
    const std::string head = "description = \"d\"\n";
    EXPECT_THAT(message("description = \"d"), HasSubstr("not valid TOML"));
    EXPECT_THAT(message("# nothing\n"), HasSubstr("'description' is missing"));
    message("");
    EXPECT_THAT(message(head + "wnd = [0, 0, 0]\n"), HasSubstr("did you mean 'wind'?"));
    EXPECT_THAT(message(head + "wind = [0, 0]\n"), HasSubstr(":2: "));
    EXPECT_THAT(message(head + "wind = [0, 0, 1000]\n"), HasSubstr("expected three numbers -100..100"));
    EXPECT_THAT(message(head + "dust_albedo = [2, 0, 0]\n"), HasSubstr("each 0..1"));
    EXPECT_THAT(message(head + "[terrain]\nkind = \"hilly\"\n"), HasSubstr("one of flat, height_field"));
    EXPECT_THAT(message(head + "[sun]\nelevation_degrees = 100\nazimuth_degrees = 0\n"), HasSubstr("0..90"));
    EXPECT_THAT(message(head + "[vehicle]\nmass_kilograms = nan\n"), HasSubstr(":3: "));
    EXPECT_THAT(message(head + "[camera.front]\nx = 1\n"), HasSubstr("'front'"));
    EXPECT_THAT(message(head + "[camera.fixed]\neye = [1, 1, 1]\ntarget = [1, 1, 1]\n"),
                HasSubstr("a point other than 'eye'"));
    EXPECT_THAT(message(head + "[[solid]]\nname = \"a\"\nmesh = \"none.obj\"\n"),
                HasSubstr("'none.obj': no such file, tried "));
    EXPECT_THAT(message(head + "[[solid]]\nname = \"a\"\nmesh = \"bad.obj\"\n"), HasSubstr("bad.obj"));
    const std::string field = "[terrain]\nkind = \"height_field\"\nspacing_metres = 1\nheight_metres = 1\n";
    EXPECT_THAT(message(head + field + "image = \"none.png\"\n"), HasSubstr("none.png"));
    EXPECT_THAT(message(head + field + "image = \"bad.png\"\n"), HasSubstr("bad.png"));
}

TEST(HeightImage, IsCentredAndScaledFromBlackToWhite) {
    const TestFolder folder;
    const auto file = folder.write("h.pgm", std::string("P5\n3 2\n255\n") + std::string("\x00\xff\x00\xff\x00\xff", 6));
    const scene::Terrain terrain = readHeightImage(file, 2, 10, -4);
    EXPECT_EQ(terrain.columns(), 3);
    EXPECT_EQ(terrain.rows(), 2);
    EXPECT_EQ(terrain.origin(), glm::vec2(-2, -1));
    EXPECT_FLOAT_EQ(terrain.heightAt(-2, -1), -4);
    EXPECT_FLOAT_EQ(terrain.heightAt(0, -1), 6);
    EXPECT_FLOAT_EQ(terrain.heightAt(-2, 1), 6);
}

TEST(HeightImage, IsAsStoredWhateverTheFileSaysOfItsColours) {
    const TestFolder folder;
    // A PNG of 2x2 pixels, 0 128 255 51, which is linear light by its gAMA chunk.
    constexpr std::string_view linear(
        "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00\x00\x02"
        "\x08\x00\x00\x00\x00\x57\xdd\x52\xf8\x00\x00\x00\x04\x67\x41\x4d\x41\x00\x01\x86\xa0\x31\xe8\x96"
        "\x5f\x00\x00\x00\x0e\x49\x44\x41\x54\x78\x9c\x63\x60\x68\x60\xf8\x6f\x0c\x00\x04\x37\x01\xb3\x8a"
        "\x05\x3d\xd9\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82",
        87);
    const scene::Terrain terrain = readHeightImage(folder.write("h.png", linear), 2, 1, 0);
    EXPECT_FLOAT_EQ(terrain.heightAt(-1, -1), 0);
    EXPECT_FLOAT_EQ(terrain.heightAt(1, -1), 128 / 255.0f);
    EXPECT_FLOAT_EQ(terrain.heightAt(-1, 1), 1);
    EXPECT_FLOAT_EQ(terrain.heightAt(1, 1), 51 / 255.0f);
}

TEST(HeightImage, IsRefusedByItsHeaderWhereItIsTooLarge) {
    const TestFolder folder;
    // No pixels follow, so only the header can be the reason.
    const auto file = folder.write("h.pgm", "P5\n8193 2\n255\n");
    EXPECT_THAT(inputError([&] { (void)readHeightImage(file, 1, 1, 0); }),
                HasSubstr("h.pgm: the height field has 8193 x 2 pixels, expected 2..8192 a side"));
}

TEST(DataList, DescribesEverySceneAndDrive) {
    for (const auto& entries : {listScenes(), listDrives()}) {
        EXPECT_FALSE(entries.empty());
        for (const DataEntry& entry : entries) {
            EXPECT_FALSE(entry.description.empty()) << entry.id;
            EXPECT_EQ(entry.description.find("cannot be read"), std::string::npos) << entry.description;
        }
    }
    EXPECT_TRUE(std::ranges::any_of(listDrives(), [](const DataEntry& entry) { return entry.id == "ece15"; }));
}

}  // namespace
}  // namespace dustbench::world
