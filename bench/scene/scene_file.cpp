#include "bench/scene/scene_file.h"

#include <algorithm>
#include <cmath>

#include "bench/scene/car_model.h"
#include "bench/scene/height_image.h"
#include "bench/scene/panel_table.h"
#include "bench/scene/scene_values.h"
#include "bench/scene/solid_table.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::bench {
namespace {

using files::TomlReader;

constexpr double furthestMetres = 1e5;  ///< metres: the maximum coordinate in a file

/// Reads the table under a key if present, and rejects unknown keys in it.
template <typename Read>
void readTable(TomlReader& parent, std::string_view key, const Read& read) {
    if (!parent.has(key)) return;
    TomlReader table = parent.table(key);
    read(table);
    table.finish();
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

}  // namespace dustbench::bench
