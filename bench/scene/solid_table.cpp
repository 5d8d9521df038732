#include "bench/scene/solid_table.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <utility>

#include "bench/scene/scene_values.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/meshes/mesh_file.h"

namespace dustbench::bench {
namespace {

using files::TomlReader;
using std::filesystem::path;

constexpr double longest = 1e5;      ///< seconds
constexpr double mostDegrees = 1e7;  ///< of a rotation

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

}  // namespace

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

}  // namespace dustbench::bench
