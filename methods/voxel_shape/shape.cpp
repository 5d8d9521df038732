#include "methods/voxel_shape/shape.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/voxel_shape/voxels/solid_fill.h"

namespace dustbench::voxel_shape {
namespace {

using files::TomlReader;

constexpr double far = 1e4;  ///< metres: the largest coordinate allowed in a file

constexpr Choices<Force> forces{{"linear", Force::linear},
                                {"orbit", Force::orbit},
                                {"spiral", Force::spiral},
                                {"helix", Force::helix},
                                {"gravity", Force::gravity}};

template <typename Enumeration>
Enumeration choice(TomlReader& table, const char* key, const Choices<Enumeration>& choices, Enumeration initial) {
    return table.has(key) ? table.choice(key, choices) : initial;
}

float number(TomlReader& table, const char* key, double minimum, double maximum, float initial) {
    return static_cast<float>(table.number(key, minimum, maximum, static_cast<double>(initial)));
}

glm::vec3 vector(TomlReader& table, const char* key, double maximum, const glm::dvec3& initial) {
    const glm::dvec3 value = table.vector3(key, initial);
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(value[axis]) > maximum)
            throw InputError(table.where(key) + "key '" + key + "': got " + std::to_string(value[axis]) +
                             ", allowed: " + std::to_string(-maximum) + ".." + std::to_string(maximum));
    return value;
}

glm::vec3 colour(TomlReader& table, const char* key, const glm::vec3& initial) {
    const glm::vec3 value = vector(table, key, 1, initial);
    if (glm::any(glm::lessThan(value, glm::vec3(0))))
        throw InputError(table.where(key) + "key '" + key + "': expected a linear RGB colour, each 0..1");
    return value;
}

VoxelChange::ForceEffect readForce(TomlReader table) {
    VoxelChange::ForceEffect effect{};
    effect.kind = choice(table, "kind", forces, Force::linear);
    if (effect.kind == Force::linear) {
        effect.vector = vector(table, "acceleration", 1000, glm::dvec3(0));
    } else {
        const glm::vec3 axis = effect.kind == Force::gravity ? glm::vec3(0, 1, 0) : vector(table, "axis", 1, {0, 1, 0});
        if (!(glm::length(axis) > 0))
            throw InputError(table.where("axis") + "key 'axis': expected a vector of non-zero length");
        effect.vector = glm::normalize(axis) * number(table, "radians_per_second", -60, 60, 2);
    }
    if (effect.kind == Force::spiral) effect.number = number(table, "growth_per_radian", -1, 1, 0.02f);
    if (effect.kind == Force::helix) effect.number = number(table, "metres_per_radian", -10, 10, 0.05f);
    table.finish();
    return effect;
}

VoxelChange readChange(TomlReader& table) {
    VoxelChange change;
    const auto read = [&](const char* key, std::optional<float>& value, double minimum, double maximum) {
        if (table.has(key)) value = static_cast<float>(table.number(key, minimum, maximum));
    };
    if (table.has("active")) change.active = table.boolean("active", true);
    if (table.has("colour")) change.colour = colour(table, "colour", {});
    if (table.has("fading_colour")) change.fadingColour = colour(table, "fading_colour", {});
    read("opacity", change.opacity, 0, 0.999);
    read("fading_opacity", change.fadingOpacity, 0, 0.999);
    read("size_voxels", change.sizeVoxels, 0, 100);
    read("fading_size_voxels", change.fadingSizeVoxels, 0, 100);
    read("lifetime_seconds", change.lifetimeSeconds, 0, 1000);
    read("interpolation_seconds", change.interpolationSeconds, 0, 1000);
    read("pictures_per_second", change.picturesPerSecond, 0, 1000);
    if (table.has("maximum_density"))
        change.maximumDensity = static_cast<std::uint32_t>(table.integer("maximum_density", 0, 10'000'000));
    if (table.has("force")) change.force = readForce(table.table("force"));
    return change;
}

/// The file named by `key` in the shape file `from`.
std::filesystem::path fileAt(TomlReader& table, std::string_view key, const std::filesystem::path& from) {
    try {
        return files::fileNamedBy(from, "shapes", table.text(key));
    } catch (const InputError& error) {
        throw InputError(table.where(key) + "key '" + std::string(key) + "': " + error.what());
    }
}

/// Reads the interior of a closed mesh, placed in the shape's frame.
std::shared_ptr<const SolidSpace> readRegion(TomlReader& table, const std::filesystem::path& from) {
    const scene::Mesh mesh = meshes::readMesh(fileAt(table, "mesh", from), glm::vec3(0));
    if (meshes::openEdges(mesh) > 0)
        throw InputError(table.where("mesh") + "key 'mesh': the mesh has " + std::to_string(meshes::openEdges(mesh)) +
                         " open edges, expected a closed mesh");
    const glm::vec3 place = vector(table, "position", far, glm::dvec3(0));
    const auto scale = static_cast<float>(table.number("scale", 1e-3, 1e3, 1));
    return std::make_shared<const SolidSpace>(mesh, glm::scale(glm::translate(glm::mat4(1), place), glm::vec3(scale)));
}

/// Reads the mesh, or `mesh_otherwise` if it is missing.
void readMeshName(TomlReader& file, const std::filesystem::path& from, Shape& shape) {
    const std::string mesh = file.text("mesh");
    shape.source = mesh == "vehicle" ? Source::vehicle : Source::mesh;
    const bool hasOther = file.has("mesh_otherwise");
    const std::string other = file.text("mesh_otherwise", "");
    if (shape.source == Source::vehicle) return;
    try {
        shape.mesh = fileAt(file, "mesh", from);
    } catch (const InputError&) {
        if (!hasOther) throw;
        shape.mesh = fileAt(file, "mesh_otherwise", from);
    }
}

/// A shape file may be untrusted, so it may write only a voxel file in its own folder.
std::filesystem::path savedVoxelsAt(TomlReader& file, const std::filesystem::path& from) {
    const std::filesystem::path named = file.text("save_voxels_as", "");
    if (named.empty()) return {};
    const auto folder = std::filesystem::weakly_canonical(std::filesystem::absolute(from).parent_path());
    const auto target = std::filesystem::weakly_canonical(folder / named), relative = target.lexically_relative(folder);
    if (named.extension() != ".vti" || relative.empty() || *relative.begin() == ".." || target == folder ||
        target.extension() != ".vti")
        throw InputError(file.where("save_voxels_as") + "key 'save_voxels_as': got '" + named.string() +
                         "', allowed: a file that ends in .vti, in the folder of the shape's file or below");
    return from.parent_path() / named;
}

void readSource(TomlReader& file, const std::filesystem::path& from, Shape& shape) {
    if (int{file.has("grid")} + int{file.has("mesh")} + int{file.has("voxels_from")} != 1)
        throw InputError(file.where("mesh") + "expected exactly one of mesh, [grid] and voxels_from");
    if (file.has("save_voxels_as")) shape.savedVoxels = savedVoxelsAt(file, from);
    if (file.has("voxels_from")) {
        shape.source = Source::voxels;
        shape.mesh = fileAt(file, "voxels_from", from);
        return;
    }
    if (file.has("grid")) {
        TomlReader grid = file.table("grid");
        shape.source = Source::grid;
        const glm::dvec3 cells = grid.vector3("cells");
        for (int axis = 0; axis < 3; ++axis) {
            if (!(cells[axis] >= 1 && cells[axis] <= maximumVoxelsASide))
                throw InputError(grid.where("cells") + "key 'cells': got " + std::to_string(cells[axis]) +
                                 ", allowed: 1.." + std::to_string(maximumVoxelsASide));
            shape.gridCells[axis] = static_cast<int>(cells[axis]);
        }
        shape.gridEdgeMetres = static_cast<float>(grid.number("edge_metres", 1e-3, 100));
        grid.finish();
        return;
    }
    readMeshName(file, from, shape);
    shape.turn = glm::radians(vector(file, "turn_degrees", 360, glm::dvec3(0)));
    shape.lightFromAbove = number(file, "light_from_above", 0, 1, 0);
    shape.longestSideMetres = number(file, "longest_side_metres", 0, far, 0);
    shape.resolution = static_cast<int>(file.integer("resolution", 1, maximumVoxelsASide, shape.resolution));
    shape.voxeliser = choice(file, "voxeliser", voxelisers, shape.voxeliser);
    shape.fill = choice(file, "fill", fills, shape.fill);
    if (shape.fill == Fill::solid && shape.voxeliser != Voxeliser::conservative)
        throw InputError(file.where("fill") + "fill = \"solid\" requires voxeliser = \"conservative\"");
}

void readMotion(TomlReader& file, Shape& shape) {
    if (!file.has("motion")) return;
    TomlReader table = file.table("motion");
    Motion& motion = shape.motion;
    motion.gravity = {0, -number(table, "gravity", -100, 100, 0), 0};
    shape.windFactor = number(table, "wind_factor", 0, 10, shape.windFactor);
    motion.airDragPerSecond = number(table, "air_drag_per_second", 0, 100, motion.airDragPerSecond);
    motion.responsePerSecond = number(table, "response_per_second", 0, 1000, motion.responsePerSecond);
    motion.birthSpeed = number(table, "birth_speed", 0, 100, motion.birthSpeed);
    motion.fillSeconds = number(table, "fill_seconds", 0, 100, motion.fillSeconds);
    shape.dustDrawsPerSecond = number(table, "dust_draws_per_second", 0, 1000, shape.dustDrawsPerSecond);
    table.finish();
}

void readCollision(TomlReader& file, Shape& shape) {
    if (!file.has("collision")) return;
    TomlReader table = file.table("collision");
    shape.collidesWith.solids = table.boolean("with_solids", shape.collidesWith.solids);
    shape.collidesWith.vehicle = table.boolean("with_vehicle", shape.collidesWith.vehicle);
    shape.impact.restitution = number(table, "restitution", 0, 1, shape.impact.restitution);
    shape.impact.friction = number(table, "friction", 0, 1, shape.impact.friction);
    shape.impact.scatter = number(table, "scatter", 0, 1, shape.impact.scatter);
    if (std::hypot(shape.impact.restitution, shape.impact.scatter) > 1)
        throw InputError(table.where("scatter") + "restitution² + scatter² exceeds 1, so particles would gain energy");
    table.finish();
}

void readLook(TomlReader& file, Shape& shape) {
    if (!file.has("look")) return;
    TomlReader table = file.table("look");
    Look& look = shape.look;
    look.render = choice(table, "render", renders, look.render);
    look.pixels = number(table, "pixels", 0, 255, look.pixels);
    look.additive = table.boolean("additive", look.additive);
    look.lit = table.boolean("lit", look.lit);
    look.order = choice(table, "sort", orders, look.order);
    table.finish();
}

void readFlow(TomlReader& file, const std::filesystem::path& folder, Shape& shape) {
    if (!file.has("flow")) return;
    TomlReader table = file.table("flow");
    for (const std::string& name : table.texts("files")) {
        const auto found = files::matchingFiles(folder / name);
        shape.flow.files.insert(shape.flow.files.end(), found.begin(), found.end());
    }
    if (shape.flow.files.empty()) throw InputError(table.where("files") + "key 'files': expected at least one file");
    shape.flow.field = table.text("field", shape.flow.field);
    if (table.has("follow")) shape.flow.followsShape = table.choice("follow", {"world", "shape"}) == "shape";
    shape.flow.drawsPerSecond = number(table, "draws_per_second", 0, 1000, shape.flow.drawsPerSecond);
    if (table.has("from_seconds")) shape.flow.fromSeconds = table.number("from_seconds", -1e5, 1e5);
    shape.flow.massLoading = number(table, "mass_loading", 0, 1000, shape.flow.massLoading);
    shape.flow.wakeSeconds = number(table, "wake_seconds", 1e-3, 1e6, shape.flow.wakeSeconds);
    table.finish();
}

/// The forces that keep particles in single rows of voxels: helices around the rows' axes.
void readRowForce(TomlReader& file, Shape& shape) {
    if (!file.has("row_force")) return;
    TomlReader table = file.table("row_force");
    shape.rowForce.emplace();
    RowForce& force = *shape.rowForce;
    force.radiansPerSecond = number(table, "radians_per_second", 0, 60, force.radiansPerSecond);
    force.metresPerRadian = number(table, "metres_per_radian", -10, 10, force.metresPerRadian);
    table.finish();
}

VoxelBox readBox(TomlReader& table, std::string_view key) {
    TomlReader box = table.table(key);
    const VoxelBox read{glm::vec3(box.vector3("min")), glm::vec3(box.vector3("max"))};
    box.finish();
    return read;
}

void readLoad(TomlReader& file, Shape& shape) {
    if (!file.has("load")) return;
    TomlReader table = file.table("load");
    ElasticLoad& load = shape.load;
    load.where = table.where();
    load.held = readBox(table, "held");
    load.loaded = readBox(table, "at");
    load.newtons = glm::vec3(table.vector3("newtons"));
    if (!load.isOn()) throw InputError(table.where("newtons") + "key 'newtons': got [0, 0, 0], expected a force");
    load.poisson = table.number("poisson", 0, 0.49, load.poisson);
    load.fullPascals = number(table, "full_pascals", 0, 1e12, load.fullPascals);
    load.colour = colour(table, "colour", load.colour);
    table.finish();
}

void readStress(TomlReader& file, Shape& shape) {
    if (!file.has("stress")) return;
    TomlReader table = file.table("stress");
    shape.stress.colour = colour(table, "colour", shape.stress.colour);
    shape.stress.fullMetres = static_cast<float>(table.number("full_metres", 1e-4, far));
    if (shape.look.lit)
        throw InputError(table.where() +
                         "[stress] and lit = true: got both, allowed: one of them, since both set the voxels' colours");
    table.finish();
}

TrackKey readKey(TomlReader& table, const TrackKey& initial) {
    TrackKey key = initial;
    key.position = vector(table, "position", far, initial.position);
    key.heading = glm::radians(table.number("heading_degrees", -3600, 3600, glm::degrees(initial.heading)));
    key.scale = table.number("scale", 1e-3, 1e3, initial.scale);
    return key;
}

void readTrack(TomlReader& file, Shape& shape) {
    Track& track = shape.track;
    track.keys.push_back({});
    if (!file.has("place")) return;
    TomlReader table = file.table("place");
    track.followsVehicle = table.has("follow") ? table.choice("follow", {"vehicle", "world"}) == "vehicle" : true;
    const TrackKey rest = readKey(table, {});
    track.keys = {rest};
    for (TomlReader& keyTable : table.tables("key")) {
        TrackKey key = readKey(keyTable, rest);
        key.timeSeconds = keyTable.number("time_seconds", 0, 1e5);
        const bool first = track.keys.size() == 1 && key.timeSeconds == 0;
        if (first)
            track.keys.front() = key;
        else if (key.timeSeconds > track.keys.back().timeSeconds)
            track.keys.push_back(key);
        else
            throw InputError(keyTable.where("time_seconds") +
                             "key 'time_seconds': expected times that increase from 0");
        keyTable.finish();
    }
    table.finish();
}

/// Reads the further shapes of a scene.
void readOthers(TomlReader& file, const std::filesystem::path& from, Shape& shape) {
    for (TomlReader& table : file.tables("also")) {
        Shape other = readShape(fileAt(table, "shape", from));
        if (!other.others.empty())
            throw InputError(table.where("shape") + "key 'shape': " + other.name +
                             " contains further shapes ([[also]]); expected a single shape");
        shape.others.push_back(std::move(other));
        table.finish();
    }
    if (!file.has("crossing")) return;
    TomlReader table = file.table("crossing");
    shape.drawnAlongPerSecond = number(table, "drawn_along_per_second", 0, 1000, shape.drawnAlongPerSecond);
    table.finish();
}

}  // namespace

VoxelEdit readEdit(TomlReader& table, const std::filesystem::path& from) {
    VoxelEdit edit;
    edit.where = table.where();
    const bool box = table.has("min") || table.has("max"),
               sphere = table.has("centre") || table.has("radius_metres") || table.has("to"), mesh = table.has("mesh");
    if (int{box} + int{sphere} + int{mesh} != 1)
        throw InputError(edit.where +
                         "an edit takes either a box (min, max), a sphere (centre, radius_metres) or a closed mesh");
    if (sphere) {
        edit.region = VoxelEdit::Region::sphere;
        edit.centre = table.vector3("centre");
        edit.end = table.has("to") ? glm::vec3(table.vector3("to")) : edit.centre;
        edit.radiusMetres = static_cast<float>(table.number("radius_metres", 1e-4, far));
    } else if (mesh) {
        edit.region = VoxelEdit::Region::mesh;
        edit.mesh = readRegion(table, from);
    } else {
        edit.minimum = table.vector3("min");
        edit.maximum = table.vector3("max");
        if (glm::any(glm::greaterThan(edit.minimum, edit.maximum)))
            throw InputError(edit.where + "the edit's min lies beyond its max");
    }
    edit.change = readChange(table);
    if (edit.change.isEmpty()) throw InputError(edit.where + "the edit changes nothing");
    if (edit.change.contradictsItself())
        throw InputError(
            edit.where +
            "the edit contradicts itself: `active = false` removes voxels, so other attributes are not allowed");
    table.finish();
    return edit;
}

Shape readShape(const std::filesystem::path& path) {
    TomlReader file = TomlReader::parseFile(path);
    Shape shape;
    shape.name = path.filename().string();
    (void)file.text("description");
    readSource(file, path, shape);
    shape.meshColour = colour(file, "colour", shape.meshColour);
    shape.particles = static_cast<std::uint32_t>(file.integer("particles", 1, 10'000'000, shape.particles));
    if (shape.source == Source::voxels && (file.has("voxels") || file.has("particles")))
        throw InputError(
            file.where("voxels_from") +
            "the voxel file defines all attributes: [voxels] and particles are not allowed with it, edits are");

    if (file.has("voxels")) {
        TomlReader table = file.table("voxels");
        shape.voxels = readChange(table);
        if (shape.voxels.active) throw InputError(table.where("active") + "key 'active': allowed only in an edit");
        table.finish();
    }
    const auto otherwise = [](std::optional<float>& value, float initial) {
        if (!value) value = initial;
    };
    otherwise(shape.voxels.opacity, 0.5f);
    otherwise(shape.voxels.fadingOpacity, 0);
    otherwise(shape.voxels.sizeVoxels, 0.8f);
    otherwise(shape.voxels.lifetimeSeconds, 1);
    otherwise(shape.voxels.interpolationSeconds, 0.2f);
    otherwise(shape.voxels.picturesPerSecond, 0);
    if (!shape.voxels.fadingSizeVoxels) shape.voxels.fadingSizeVoxels = shape.voxels.sizeVoxels;
    for (TomlReader& table : file.tables("edit")) shape.edits.push_back(readEdit(table, path));
    readMotion(file, shape);
    readCollision(file, shape);
    readLook(file, shape);
    readRowForce(file, shape);
    readLoad(file, shape);
    readStress(file, shape);
    readFlow(file, path.parent_path(), shape);
    readTrack(file, shape);
    readOthers(file, path, shape);
    file.finish();
    return shape;
}

}  // namespace dustbench::voxel_shape
