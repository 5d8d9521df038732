#include "bench/scene/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "bench/scene/data_list.h"
#include "bench/scene/height_image.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::bench {
namespace {

using ::testing::HasSubstr;

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
}  // namespace dustbench::bench
