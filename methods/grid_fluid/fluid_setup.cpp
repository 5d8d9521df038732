#include "methods/grid_fluid/fluid_setup.h"

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::grid_fluid {
namespace {

using files::TomlReader;

constexpr double far = 1e5;  ///< metres: the maximum coordinate in a file

float number(TomlReader& table, const char* key, double minimum, double maximum, float initial) {
    return static_cast<float>(table.number(key, minimum, maximum, static_cast<double>(initial)));
}

glm::dvec3 within(TomlReader& table, const char* key, double minimum, double maximum, const glm::dvec3& initial) {
    const glm::dvec3 value = table.vector3(key, initial);
    for (int axis = 0; axis < 3; ++axis)
        if (!(value[axis] >= minimum && value[axis] <= maximum))
            throw InputError(table.where(key) + "key '" + key + "': got " + std::to_string(value[axis]) +
                             ", allowed: " + std::to_string(minimum) + ".." + std::to_string(maximum));
    return value;
}

void readBox(TomlReader table, FluidSetup& setup) {
    setup.followsVehicle = table.boolean("follows_vehicle", false);
    setup.lengthMetres = table.number("length_metres", 1e-3, 1e4);
    if (setup.followsVehicle) {
        setup.aheadMetres = table.number("ahead_metres", 0, 1e4, setup.aheadMetres);
        setup.belowMetres = table.number("below_metres", 0, 1e4, 0);
    } else {
        setup.middleMetres = within(table, "floor_middle", -far, far, setup.middleMetres);
    }
    table.finish();
}

void readFlow(TomlReader table, FluidSetup& setup) {
    flow::ForceSettings& forces = setup.forces;
    forces.buoyancyPerKelvin = number(table, "buoyancy_per_kelvin", 0, 1e3, forces.buoyancyPerKelvin);
    forces.weightPerDensity = number(table, "weight_per_density", 0, 1e3, forces.weightPerDensity);
    forces.confinementPerSecond = number(table, "vorticity_per_second", 0, 1e3, forces.confinementPerSecond);
    forces.densityDecayPerSecond = number(table, "decay_per_second", 0, 1e3, forces.densityDecayPerSecond);
    forces.coolingPerSecond = number(table, "cooling_per_second", 0, 1e3, forces.coolingPerSecond);
    forces.reactionLossPerSecond = number(table, "burning_per_second", 0, 1e3, forces.reactionLossPerSecond);
    forces.viscosityM2PerSecond = number(table, "diffusion_m2_per_second", 0, 1e3, forces.viscosityM2PerSecond);
    setup.noSlip = table.boolean("no_slip", false);
    setup.keepsDensity = table.boolean("keeps_density", false);
    table.finish();
}

void readLook(TomlReader table, const std::filesystem::path& folder, FluidLook& look) {
    look.extinctionPerMetre = table.number("extinction_per_metre", 0, 1e6, look.extinctionPerMetre);
    look.shadowCells = static_cast<int>(table.integer("shadow_cells", 0, 16, 0));
    if (table.has("albedo")) look.albedo = within(table, "albedo", 0, 1, {});
    if (const std::string fire = table.text("fire", ""); !fire.empty()) look.fire = folder / fire;
    table.finish();
}

SourceSetup readSource(TomlReader& table) {
    SourceSetup source;
    source.at = table.choice("at", sourcePlaces);
    if (source.at == SourceAt::point) source.centreMetres = within(table, "centre", -far, far, {});
    if (source.at == SourceAt::solid) {
        source.solid = table.text("solid");
        source.balls = static_cast<int>(table.integer("balls", 1, 100'000));
    }
    source.radiusMetres = table.number("radius_metres", 1e-3, 1e3);
    if (source.at == SourceAt::wheels) {
        source.speedShare = number(table, "speed_share", 0, 10, 0);
        source.inherit = number(table, "inherit", 0, 1, 0);
    } else {
        source.densityPerSecond = number(table, "density_per_second", 0, 1e6, 0);
        source.swing = number(table, "swing", 0, 1, 0);
        source.swingSeconds = number(table, "swing_seconds", 1e-3, 1e3, source.swingSeconds);
        source.chance = number(table, "chance", 0, 1, 0);
    }
    source.kelvinPerSecond = number(table, "kelvin_per_second", -1e6, 1e6, 0);
    source.reaction = number(table, "reaction", 0, 1, 0);
    source.velocity = within(table, "velocity", -1e3, 1e3, {});
    source.velocityPerSecond = number(table, "velocity_per_second", 0, 1e3, 0);
    table.finish();
    return source;
}

/// A scroll moves the whole box, so it is delayed until it is worthwhile.
constexpr int minimumCells = 4;

}  // namespace

FluidSetup readFluid(const std::filesystem::path& path) {
    TomlReader file = TomlReader::parseFile(path);
    FluidSetup setup;
    setup.name = path.stem().string();
    setup.description = file.text("description");
    readBox(file.table("box"), setup);
    if (file.has("flow")) readFlow(file.table("flow"), setup);
    if (file.has("look")) readLook(file.table("look"), path.parent_path(), setup.look);
    for (TomlReader& table : file.tables("source")) setup.sources.push_back(readSource(table));
    if (setup.sources.empty()) throw InputError(file.where("source") + "got no [[source]], expected at least one");
    file.finish();
    return setup;
}

glm::dvec3 wantedOrigin(const FluidSetup& setup, const flow::FluidBox& box, const scene::Terrain& terrain,
                        const scene::VehicleState& vehicle) {
    const glm::dvec3 extent = glm::dvec3(box.cells) * box.spacingMetres;
    if (!setup.followsVehicle) return setup.middleMetres - glm::dvec3(extent.x / 2, 0, extent.z / 2);
    const glm::dvec3 forward = vehicle.forward();
    glm::dvec3 origin = vehicle.position - extent / 2.0;
    for (const int axis : {0, 2}) origin[axis] -= forward[axis] * std::max(0.0, extent[axis] / 2 - setup.aheadMetres);
    origin.y = terrain.isFlat() ? 0 : vehicle.position.y - setup.belowMetres;
    return glm::round(origin / box.spacingMetres) * box.spacingMetres;
}

glm::ivec3 dueScroll(const flow::FluidBox& box, const glm::dvec3& wantedOrigin) {
    const glm::dvec3 cells = glm::round((wantedOrigin - box.originMetres) / box.spacingMetres);
    if (std::max({std::abs(cells.x), std::abs(cells.y), std::abs(cells.z)}) < minimumCells) return glm::ivec3(0);
    // A jump of the vehicle beyond the whole box empties it, however far it is.
    const glm::dvec3 maximum(1e6);
    return {glm::clamp(cells, -maximum, maximum)};
}

}  // namespace dustbench::grid_fluid
