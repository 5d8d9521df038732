#include "bench/world/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/world/car_model.h"
#include "bench/world/moving_solids.h"
#include "bench/world/panel_table.h"
#include "methods/contract/errors.h"
#include "methods/contract/scene.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/kit/pictures/picture_files.h"

namespace dustbench::world {
namespace {

using files::TomlReader;
using std::filesystem::path;

constexpr double furthestMetres = 1e5;  ///< the maximum coordinate in a file
constexpr double longest = 1e5;         ///< seconds
constexpr double mostDegrees = 1e7;     ///< of a rotation

/// Reads the table under a key if present, and rejects unknown keys in it.
template <typename Read>
void readTable(TomlReader& parent, std::string_view key, const Read& read) {
    if (!parent.has(key)) return;
    TomlReader table = parent.table(key);
    read(table);
    table.finish();
}

/// In radians; the bounds are in degrees, as in the file.
double readAngle(TomlReader& table, std::string_view key, double minimum, double maximum, double initial) {
    return glm::radians(table.number(key, minimum, maximum, glm::degrees(initial)));
}

/// Three numbers within bounds; `expected` describes them in messages.
glm::dvec3 readBounded(TomlReader& table, std::string_view key, glm::dvec3 initial, double minimum, double maximum,
                       const char* expected) {
    const glm::dvec3 value = table.vector3(key, initial);
    for (int i = 0; i < 3; ++i)
        if (value[i] < minimum || value[i] > maximum)
            throw InputError(table.where(key) + "key '" + std::string(key) + "': expected " + expected);
    return value;
}

/// Each channel 0..`maximum`, which is 1 or 100.
glm::vec3 readColour(TomlReader& table, std::string_view key, glm::vec3 initial, double maximum) {
    return readBounded(table, key, initial, 0, maximum,
                       maximum == 1 ? "a linear RGB colour, each 0..1" : "a linear RGB colour, each 0..100");
}

/// Within 100 km of the world's origin along each axis.
glm::dvec3 readPoint(TomlReader& table, std::string_view key, glm::dvec3 initial) {
    return readBounded(table, key, initial, -1e5, 1e5, "three numbers -100000..100000, metres");
}

struct ReadMesh {
    std::shared_ptr<const scene::Mesh> mesh;
    std::optional<meshes::MorphMesh> morph;  ///< if the solid has targets
};

ReadMesh readMesh(TomlReader& table, const path& from, std::vector<path>& files) {
    const std::string named = table.text("mesh");
    const glm::vec3 paint = readColour(table, "colour", glm::vec3(0.5f), 1);
    std::vector<path> targets;
    std::string key = "mesh";
    const auto fileOf = [&](const std::string& name) {
        files.push_back(files::fileNamedBy(from, "scenes", name));
        return files.back();
    };
    try {
        const path file = fileOf(named);
        if (!table.has("targets")) return {std::make_shared<scene::Mesh>(meshes::readMesh(file, paint)), std::nullopt};
        key = "targets";
        for (const std::string& target : table.texts(key)) targets.push_back(fileOf(target));
        meshes::MorphMesh morph = meshes::readMorphMesh(file, targets, paint);
        return {std::make_shared<scene::Mesh>(morph.rest), std::move(morph)};
    } catch (const InputError& error) {
        throw InputError(table.where(key) + error.what());
    }
}

glm::dvec3 readTurn(TomlReader& table, const glm::dvec3& initialDegrees) {
    return readBounded(table, "rotation_degrees", initialDegrees, -mostDegrees, mostDegrees,
                       "three angles -10000000..10000000, degrees");
}

/// `rest`: the default values of a key; `turn` in degrees, as in the file.
SolidKey readKey(TomlReader& table, const SolidKey& rest) {
    SolidKey key;
    key.seconds = table.number("time_seconds", -longest, longest);
    key.position = readPoint(table, "position", rest.position);
    key.turn = readTurn(table, rest.turn);
    key.weights = rest.weights;
    if (table.has("weights")) key.weights = table.numbers("weights");
    if (key.weights.size() != rest.weights.size())
        throw InputError(fmt::format("{}key 'weights': got {} numbers, expected {}, one for each target of the solid",
                                     table.where("weights"), key.weights.size(), rest.weights.size()));
    for (const double weight : key.weights)
        if (!(std::abs(weight) <= 100))
            throw InputError(
                fmt::format("{}key 'weights': got {}, expected numbers -100..100", table.where("weights"), weight));
    table.finish();
    return key;
}

void requireReturn(const SolidKey& first, const SolidKey& last, const std::string& where) {
    const auto refuse = [&](const char* what) {
        throw InputError(where + "key 'keys_repeat': the last key has a different " + what +
                         " from the first, expected the same (rotations: up to whole turns)");
    };
    if (first.position != last.position) refuse("position");
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(std::remainder(last.turn[axis] - first.turn[axis], 360.0)) > 1e-9) refuse("rotation");
    if (first.weights != last.weights) refuse("weight");
}

/// The keys in radians, with positions above the ground.
std::optional<SolidPath> readPath(TomlReader& table, const SolidKey& rest, const scene::Terrain* ground) {
    std::vector<SolidKey> keys;
    for (TomlReader& keyTable : table.tables("key")) {
        keys.push_back(readKey(keyTable, rest));
        if (keys.size() > 1 && !(keys.back().seconds > keys[keys.size() - 2].seconds))
            throw InputError(fmt::format("{}key 'time_seconds': got {}, expected more than {} (previous key)",
                                         keyTable.where("time_seconds"), keys.back().seconds,
                                         keys[keys.size() - 2].seconds));
    }
    const bool repeats = table.boolean("keys_repeat", false);
    if (repeats && keys.size() < 2)
        throw InputError(fmt::format("{}key 'keys_repeat': got {} keys, expected two or more",
                                     table.where("keys_repeat"), keys.size()));
    if (repeats) requireReturn(keys.front(), keys.back(), table.where("keys_repeat"));
    if (keys.empty()) return std::nullopt;
    for (SolidKey& key : keys) {
        key.turn = glm::radians(key.turn);
        if (ground)
            key.position.y += static_cast<double>(
                ground->heightAt(static_cast<float>(key.position.x), static_cast<float>(key.position.z)));
    }
    return SolidPath(keys, repeats);
}

/// Reads all copies of one `[[solid]]` table into `scene`. Several copies are merged into one mesh in world
/// coordinates; a single one gets a pose, and a path in `moving` if it has keys. `files` gets its meshes.
void readSolid(TomlReader& table, const path& from, scene::Scene& scene, MovingSolids& moving,
               std::vector<path>& files) {
    const std::string name = table.text("name");
    ReadMesh read = readMesh(table, from, files);
    SolidKey rest;
    rest.position = readPoint(table, "position", {});
    rest.turn = table.vector3("rotation_degrees", {});
    if (read.morph) rest.weights.assign(read.morph->offsets.size(), 0.0);
    const double scale = table.number("scale", 1e-4, 1e4, 1);
    const bool onGround = table.boolean("on_ground", true);
    const std::int64_t count = table.integer("repeat", 1, 1000, 1);
    const glm::dvec3 step = readPoint(table, "repeat_step", {});
    const double stepTurn = readAngle(table, "repeat_turn_degrees", -360, 360, 0);
    std::optional<SolidPath> solidPath = readPath(table, rest, onGround ? &scene.terrain : nullptr);
    if (solidPath && count > 1)
        throw InputError(
            fmt::format("{}key 'repeat': got {} for a solid with keys, expected 1", table.where("repeat"), count));
    if (read.morph && !solidPath)
        throw InputError(table.where("targets") + "key 'targets': requires keys, expected [[solid.key]] tables");
    table.finish();

    const glm::dvec3 turn = glm::radians(rest.turn);
    const auto pose = [&](std::int64_t copy) {
        glm::dvec3 place = rest.position + static_cast<double>(copy) * step;
        if (onGround)
            place.y +=
                static_cast<double>(scene.terrain.heightAt(static_cast<float>(place.x), static_cast<float>(place.z)));
        return glm::mat4(solidToWorld(place, turn + glm::dvec3(0, static_cast<double>(copy) * stepTurn, 0), scale));
    };
    scene::Solid solid{name, read.mesh};
    scene::SolidPose where;
    if (solidPath) {
        solid.motion = read.morph ? scene::SolidMotion::deforms : scene::SolidMotion::moves;
        where = solidPath->at(0).pose(scale);
        moving.add(scene.solids.size(), std::move(*solidPath), scale, std::move(read.morph));
    } else if (count == 1) {
        where.toWorld = pose(0);
    } else {
        auto all = std::make_shared<scene::Mesh>();
        for (std::int64_t copy = 0; copy < count; ++copy) all->append(*read.mesh, pose(copy));
        solid.mesh = all;
    }
    scene.solids.push_back(std::move(solid));
    scene.solidPoses.push_back(where);
}

double fieldOfView(TomlReader& table, double initial) {
    return readAngle(table, "field_of_view_degrees", 5, 150, initial);
}

void readTerrain(TomlReader& table, const std::filesystem::path& folder, SceneFile& result) {
    if (table.choice("kind", {"flat", "height_field"}) == "flat") return;
    const std::filesystem::path image = folder / table.text("image");
    result.files.push_back(image);
    const double spacing = table.number("spacing_metres", 0.01, 1000);
    const double height = table.number("height_metres", 0, 10000);
    const double base = table.number("base_metres", -10000, 10000, 0);
    try {
        result.scene.terrain = readHeightImage(image, spacing, height, base);
    } catch (const InputError& error) {
        throw InputError(table.where("image") + error.what());
    }
}

void readLights(TomlReader& root, scene::Lights& lights) {
    readTable(root, "sun", [&](TomlReader& table) {
        const double elevation = table.number("elevation_degrees", 0, 90);
        const double azimuth = table.number("azimuth_degrees", -360, 360);
        lights.toSun = sunDirection(glm::radians(elevation), glm::radians(azimuth));
        lights.sun = readColour(table, "colour", lights.sun, 100);
    });
    readTable(root, "sky", [&](TomlReader& table) {
        lights.ambient = readColour(table, "ambient", lights.ambient, 100);
        lights.skyZenith = readColour(table, "zenith", lights.skyZenith, 100);
        lights.skyHorizon = readColour(table, "horizon", lights.skyHorizon, 100);
        lights.hazePerMetre =
            static_cast<float>(table.number("haze_per_metre", 0, 1, static_cast<double>(lights.hazePerMetre)));
    });
}

void readVehicle(TomlReader& root, scene::Scene& result) {
    scene::VehicleParameters p;
    CarColours colours;
    readTable(root, "vehicle", [&](TomlReader& table) {
        p.wheelbaseMetres = table.number("wheelbase_metres", 1.5, 6, p.wheelbaseMetres);
        p.trackMetres = table.number("track_metres", 1, 2.5, p.trackMetres);
        p.wheelRadiusMetres = table.number("wheel_radius_metres", 0.2, 0.6, p.wheelRadiusMetres);
        p.wheelWidthMetres = table.number("wheel_width_metres", 0.1, 0.5, p.wheelWidthMetres);
        p.massKilograms = table.number("mass_kilograms", 100, 50000, p.massKilograms);
        p.steerLimit = readAngle(table, "steer_limit_degrees", 1, 45, p.steerLimit);
        p.steerRateLimit = readAngle(table, "steer_rate_limit_degrees_per_second", 1, 720, p.steerRateLimit);
        p.lateralAccelerationLimit = table.number("lateral_acceleration_limit", 0.1, 50, p.lateralAccelerationLimit);
        p.driveAccelerationLimit = table.number("drive_acceleration_limit", 0.1, 50, p.driveAccelerationLimit);
        p.drivePowerWatts = table.number("drive_power_watts", 1e3, 1e7, p.drivePowerWatts);
        p.brakeDecelerationLimit = table.number("brake_deceleration_limit", 0.1, 50, p.brakeDecelerationLimit);
        p.dragAreaSquareMetres = table.number("drag_area_square_metres", 0, 20, p.dragAreaSquareMetres);
        p.rollingResistance = table.number("rolling_resistance", 0, 1, p.rollingResistance);
        p.topSpeed = table.number("top_speed", 1, 150, p.topSpeed);
        colours.paint = readColour(table, "paint", colours.paint, 1);
        colours.stripe = readColour(table, "stripe", colours.stripe, 1);
    });
    result.vehicle = scene::VehicleModel{
        p,
        {"body", std::make_shared<scene::Mesh>(carBody(p, colours))},
        {"wheel", std::make_shared<scene::Mesh>(carWheel(p))},
    };
}

void readCameras(TomlReader& root, CameraSet& cameras) {
    readTable(root, "camera", [&](TomlReader& kinds) {
        readTable(kinds, "chase", [&](TomlReader& table) {
            ChaseCamera& camera = cameras.chase;
            camera.offset = readPoint(table, "offset", camera.offset);
            camera.lookAt = readPoint(table, "look_at", camera.lookAt);
            camera.smoothingSeconds = table.number("smoothing_seconds", 0, 60, camera.smoothingSeconds);
            camera.verticalFieldOfView = fieldOfView(table, camera.verticalFieldOfView);
        });
        readTable(kinds, "fixed", [&](TomlReader& table) {
            FixedCamera& camera = cameras.fixed;
            camera.eye = readPoint(table, "eye", camera.eye);
            camera.target = readPoint(table, "target", camera.target);
            camera.verticalFieldOfView = fieldOfView(table, camera.verticalFieldOfView);
            if (camera.eye == camera.target)
                throw InputError(table.where("target") +
                                 "key 'camera.fixed.target': expected a point other than 'eye'");
        });
        readTable(kinds, "orbit", [&](TomlReader& table) {
            OrbitCamera& camera = cameras.orbit;
            camera.radiusMetres = table.number("radius_metres", 0.5, 1e4, camera.radiusMetres);
            camera.heightMetres = table.number("height_metres", 0, 1e4, camera.heightMetres);
            camera.turnRate = readAngle(table, "turn_degrees_per_second", -360, 360, camera.turnRate);
            camera.startAngle = readAngle(table, "start_degrees", -360, 360, camera.startAngle);
            camera.lookAt = readPoint(table, "look_at", camera.lookAt);
            camera.verticalFieldOfView = fieldOfView(table, camera.verticalFieldOfView);
        });
        readTable(kinds, "wheel", [&](TomlReader& table) {
            WheelCamera& camera = cameras.wheel;
            camera.offset = readPoint(table, "offset", camera.offset);
            camera.lookAt = readPoint(table, "look_at", camera.lookAt);
            camera.verticalFieldOfView = fieldOfView(table, camera.verticalFieldOfView);
        });
    });
}

}  // namespace

glm::vec3 sunDirection(double elevation, double azimuth) {
    return {std::cos(elevation) * std::cos(azimuth), std::sin(elevation), -std::cos(elevation) * std::sin(azimuth)};
}

SceneFile readScene(const std::filesystem::path& file) {
    TomlReader root = TomlReader::parseFile(file);
    const std::filesystem::path folder = file.parent_path();
    SceneFile result;
    result.files.push_back(file);
    result.scene.id = file.stem().string();
    result.description = root.text("description");
    result.drive = files::fromFile(file, root.text("drive", "straight"), ".csv");
    result.dust = files::fromFile(file, root.text("dust", "wheel_dust"), ".toml");
    result.isDrawn = root.boolean("drawn", true);
    readTable(root, "terrain", [&](TomlReader& table) { readTerrain(table, folder, result); });
    readTable(root, "start", [&](TomlReader& table) {
        result.start.x = table.number("x", -furthestMetres, furthestMetres, 0);
        result.start.z = table.number("z", -furthestMetres, furthestMetres, 0);
        result.start.heading = readAngle(table, "heading_degrees", -360, 360, 0);
    });
    readLights(root, result.scene.lights);
    result.scene.wind = readBounded(root, "wind", {}, -100, 100, "three numbers -100..100, metres per second");
    result.scene.dustAlbedo = readColour(root, "dust_albedo", result.scene.dustAlbedo, 1);
    result.scene.dustAsymmetry =
        static_cast<float>(root.number("dust_asymmetry", -0.95, 0.95, static_cast<double>(result.scene.dustAsymmetry)));
    readVehicle(root, result.scene);
    readCameras(root, result.cameras);
    for (TomlReader& table : root.tables("solid"))
        readSolid(table, file, result.scene, result.movingSolids, result.files);
    for (TomlReader& table : root.tables("panel"))
        result.scene.panels.push_back(readPanel(table, file, result.scene, result.files));
    root.finish();
    return result;
}

scene::Terrain readHeightImage(const std::filesystem::path& file, double spacingMetres, double heightMetres,
                               double baseMetres) {
    pictures::StoredPicture image;
    const auto fail = [&](const std::string& reason) {
        throw InputError(file.string() + ": not an image that can be read: " + reason);
    };
    if (const std::string reason = pictures::readPictureSize(file, image); !reason.empty()) fail(reason);
    const auto isAllowed = [](int edge) { return edge >= 2 && edge <= files::limits::heightEdge; };
    if (!isAllowed(image.width) || !isAllowed(image.height))
        throw InputError(file.string() + ": the height field has " + std::to_string(image.width) + " x " +
                         std::to_string(image.height) + " pixels, expected 2.." +
                         std::to_string(files::limits::heightEdge) + " a side");
    if (const std::string reason = pictures::readPicture(file, image); !reason.empty()) fail(reason);
    files::noteIgnored(file, pictures::unusedParts(image, 1, false));
    std::vector<float> heights(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const float share = image.values[i * static_cast<std::size_t>(image.channels)];
        if (!std::isfinite(share)) throw InputError(file.string() + ": a height is not a finite number");
        heights[i] = static_cast<float>(baseMetres + heightMetres * static_cast<double>(share));
    }
    const auto firstOf = [&](int samples) { return static_cast<float>(-0.5 * spacingMetres * (samples - 1)); };
    return {std::move(heights),   image.width,          image.height, static_cast<float>(spacingMetres),
            firstOf(image.width), firstOf(image.height)};
}

}  // namespace dustbench::world
