#include "bench/world/cameras.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"

namespace dustbench::world {
namespace {

/// Minimum height of a camera above the ground.
constexpr double groundClearance = 0.5;

/// Transforms a point from the level frame with the given heading to the world.
glm::dvec3 turned(const glm::dvec3& point, double heading, const glm::dvec3& origin) {
    const glm::dvec3 ahead(std::cos(heading), 0, -std::sin(heading));
    const glm::dvec3 right(-ahead.z, 0, ahead.x);
    return origin + point.x * ahead + glm::dvec3(0, point.y, 0) + point.z * right;
}

glm::dvec3 aboveGround(glm::dvec3 eye, const scene::Terrain& terrain) {
    const double ground = static_cast<double>(terrain.heightAt(static_cast<float>(eye.x), static_cast<float>(eye.z)));
    eye.y = std::max(eye.y, ground + groundClearance);
    return eye;
}

constexpr std::size_t poseNumbers = 7;
using Pose = std::array<double, poseNumbers>;  ///< eye, target, field of view

constexpr std::array<const char*, 1 + poseNumbers> pathColumns{"time_s",   "eye_x",    "eye_y",    "eye_z",
                                                               "target_x", "target_y", "target_z", "fov_deg"};

struct Range {
    double minimum, maximum;
};
Range allowed(std::size_t column) {
    if (column == 0) return {0, 1e6};
    return column == poseNumbers ? Range{5, 150} : Range{-1e5, 1e5};
}

std::string header() {
    std::string text;
    for (const char* column : pathColumns) text.append(text.empty() ? "" : ",").append(column);
    return text;
}

double cellOf(const files::CsvTable& table, std::size_t row, std::size_t column) {
    const double value = table.number(row, pathColumns[column]);
    const auto [minimum, maximum] = allowed(column);
    if (value < minimum || value > maximum)
        throw InputError(table.where(row) + "column '" + pathColumns[column] + "': got " + files::csvNumber(value) +
                         ", expected a number " + files::csvNumber(minimum) + ".." + files::csvNumber(maximum));
    return value;
}

CameraKey keyOf(const files::CsvTable& table, std::size_t row) {
    const auto cell = [&](std::size_t column) { return cellOf(table, row, column); };
    return {cell(0), {cell(1), cell(2), cell(3)}, {cell(4), cell(5), cell(6)}, cell(7)};
}

Pose poseOf(const CameraKey& key) {
    return {key.eye.x, key.eye.y, key.eye.z, key.target.x, key.target.y, key.target.z, key.fieldOfViewDegrees};
}

scene::Camera cameraOf(const Pose& pose) {
    scene::Camera camera;
    camera.eye = {pose[0], pose[1], pose[2]};
    camera.target = {pose[3], pose[4], pose[5]};
    if (camera.eye == camera.target) camera.target.z -= 1;  // between two keys they may coincide
    const glm::dvec3 along = glm::normalize(camera.target - camera.eye);
    if (glm::length(glm::cross(along, camera.up)) < 1e-6) camera.up = {1, 0, 0};
    camera.verticalFieldOfView = glm::radians(pose[6]);
    return camera;
}

/// dp/dt at key i: that of the parabola through it and its neighbours; at an end, that of the chord.
Pose velocityAt(const std::vector<CameraKey>& keys, std::size_t i) {
    const auto chord = [&](std::size_t from) {
        Pose slope = poseOf(keys[from + 1]);
        const Pose start = poseOf(keys[from]);
        for (std::size_t c = 0; c < poseNumbers; ++c)
            slope[c] = (slope[c] - start[c]) / (keys[from + 1].seconds - keys[from].seconds);
        return slope;
    };
    if (i == 0) return chord(0);
    if (i + 1 == keys.size()) return chord(i - 1);
    const double before = keys[i].seconds - keys[i - 1].seconds, after = keys[i + 1].seconds - keys[i].seconds;
    Pose velocity = chord(i - 1);
    const Pose next = chord(i);
    for (std::size_t c = 0; c < poseNumbers; ++c)
        velocity[c] = (after * velocity[c] + before * next[c]) / (before + after);
    return velocity;
}

CameraPath fromTable(const files::CsvTable& table, const std::string& name) {
    std::vector<std::string> names = table.header(), wanted(pathColumns.begin(), pathColumns.end());
    std::ranges::sort(names);
    std::ranges::sort(wanted);
    if (names != wanted) throw InputError(name + ":1: not the columns of a camera path, expected " + header());
    if (table.rows() == 0) throw InputError(name + ":2: the camera path has no rows, expected one or more");
    std::vector<CameraKey> keys;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        keys.push_back(keyOf(table, row));
        if (keys.back().eye == keys.back().target)
            throw InputError(table.where(row) + "the target equals the eye, expected another point");
        if (row > 0 && keys[row].seconds <= keys[row - 1].seconds)
            throw InputError(table.where(row) + "column 'time_s': got " + table.cell(row, "time_s") +
                             ", expected more than " + files::csvNumber(keys[row - 1].seconds) + " (previous row)");
    }
    return CameraPath(std::move(keys));
}

std::string rowOf(const CameraKey& key) {
    std::string text = files::csvNumber(key.seconds);
    for (const double value : poseOf(key)) text += "," + files::csvNumber(value);
    return text;
}

}  // namespace

CameraLag CameraLag::at(const scene::VehicleState& vehicle) {
    return {vehicle.heading, vehicle.position.y};
}

CameraLag CameraLag::followed(const scene::VehicleState& vehicle, double lagSeconds, double dt) const {
    // The exact solution of dh/dt = (h* − h)/τ for constant h*.
    const double share = lagSeconds > 0 ? 1 - std::exp(-dt / lagSeconds) : 1;
    return {heading + share * (vehicle.heading - heading), height + share * (vehicle.position.y - height)};
}

scene::Camera cameraAt(CameraKind kind, const CameraSet& cameras, const scene::SceneState& state, const CameraLag& lag,
                       const scene::Terrain& terrain) {
    const glm::dvec3 origin(state.vehicle.position.x, lag.height, state.vehicle.position.z);
    scene::Camera camera;
    switch (kind) {
        case CameraKind::fixed:
            camera.eye = cameras.fixed.eye;
            camera.target = cameras.fixed.target;
            camera.verticalFieldOfView = cameras.fixed.verticalFieldOfView;
            break;
        case CameraKind::chase:
            camera.eye = aboveGround(turned(cameras.chase.offset, lag.heading, origin), terrain);
            camera.target = turned(cameras.chase.lookAt, lag.heading, origin);
            camera.verticalFieldOfView = cameras.chase.verticalFieldOfView;
            break;
        case CameraKind::orbit: {
            const OrbitCamera& orbit = cameras.orbit;
            const glm::dvec3 middle = turned(orbit.lookAt, lag.heading, origin);
            const double angle = orbit.startAngle + orbit.turnRate * state.timeSeconds;
            const glm::dvec3 arm(orbit.radiusMetres * std::cos(angle), orbit.heightMetres,
                                 -orbit.radiusMetres * std::sin(angle));
            camera.eye = aboveGround(glm::dvec3(middle.x, origin.y, middle.z) + arm, terrain);
            camera.target = middle;
            camera.verticalFieldOfView = orbit.verticalFieldOfView;
            break;
        }
        case CameraKind::wheel:
            camera.eye = turned(cameras.wheel.offset, state.vehicle.heading, state.vehicle.position);
            camera.target = turned(cameras.wheel.lookAt, state.vehicle.heading, state.vehicle.position);
            camera.verticalFieldOfView = cameras.wheel.verticalFieldOfView;
            break;
    }
    return camera;
}

bool isCameraFile(std::string_view fileOrRows) {
    return files::isDataFile(fileOrRows, ".csv");
}

CameraPath::CameraPath(std::vector<CameraKey> keys) : keys_(std::move(keys)) {
    if (keys_.empty()) throw std::invalid_argument("CameraPath: no keys");
    for (std::size_t i = 1; i < keys_.size(); ++i)
        if (!(keys_[i].seconds > keys_[i - 1].seconds)) throw std::invalid_argument("CameraPath: times do not ascend");
}

CameraPath CameraPath::parseFile(const std::filesystem::path& file) {
    return fromTable(files::CsvTable::parseFile(file), file.string());
}

CameraPath CameraPath::parseText(std::string_view csv, const std::string& name) {
    return fromTable(files::CsvTable::parseText(csv, name), name);
}

CameraPath CameraPath::read(const std::string& fileOrRows) {
    if (isCameraFile(fileOrRows)) return parseFile(fileOrRows);
    if (fileOrRows.find(',') == std::string::npos)
        throw InputError("camera path: got '" + fileOrRows + "', expected a .csv file or rows " + header() +
                         " separated by ';'");
    std::string csv = header() + "\n" + fileOrRows + "\n";
    std::ranges::replace(csv, ';', '\n');
    return parseText(csv, "camera path");
}

scene::Camera CameraPath::at(double seconds) const {
    const auto after = std::ranges::upper_bound(keys_, seconds, {}, &CameraKey::seconds);
    if (after == keys_.begin()) return cameraOf(poseOf(keys_.front()));
    if (after == keys_.end()) return cameraOf(poseOf(keys_.back()));
    const auto i = static_cast<std::size_t>(after - keys_.begin()) - 1;
    const double span = keys_[i + 1].seconds - keys_[i].seconds;
    const double u = (seconds - keys_[i].seconds) / span, w = 1 - u;
    const Pose p0 = poseOf(keys_[i]), p1 = poseOf(keys_[i + 1]);
    const Pose v0 = velocityAt(keys_, i), v1 = velocityAt(keys_, i + 1);
    Pose pose;
    // Cubic Hermite: p = (1+2u)(1−u)²·p0 + u(1−u)²·h·v0 + u²(3−2u)·p1 − u²(1−u)·h·v1
    for (std::size_t c = 0; c < poseNumbers; ++c)
        pose[c] = (1 + 2 * u) * w * w * p0[c] + u * w * w * span * v0[c] + u * u * (3 - 2 * u) * p1[c] -
                  u * u * w * span * v1[c];
    return cameraOf(pose);
}

std::string CameraPath::csv() const {
    std::string text = header() + "\n";
    for (const CameraKey& key : keys_) text += rowOf(key) + "\n";
    return text;
}

std::string CameraPath::rows() const {
    std::string text;
    for (const CameraKey& key : keys_) text += (text.empty() ? "" : ";") + rowOf(key);
    return text;
}

}  // namespace dustbench::world
