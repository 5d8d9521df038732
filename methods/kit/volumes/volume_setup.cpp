#include "methods/kit/volumes/volume_setup.h"

#include <fmt/format.h>

#include "methods/contract/errors.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::volumes {
namespace {

using files::TomlReader;

void readSetupPlace(TomlReader& file, VolumeSetup& setup) {
    setup.zUp = file.has("up") && file.choice("up", {"y", "z"}) == "z";
    setup.metresPerUnit = file.number("scale", 1e-6, 1e6, setup.metresPerUnit);
    setup.position = file.vector3("position", setup.position);
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(setup.position[axis]) <= 1e6))
            throw InputError(fmt::format("{}key 'position': got {}, allowed: -1e6..1e6 m", file.where("position"),
                                         setup.position[axis]));
}

void readFields(TomlReader table, VolumeFields& fields) {
    fields.density = table.text("density", "");
    fields.temperature = table.text("temperature", "");
    fields.velocity = table.text("velocity", "");
    fields.clampsDensity = table.boolean("clamp_density", false);
    table.finish();
}

void readLook(TomlReader table, const std::filesystem::path& folder, VolumeSetup& setup) {
    setup.extinctionPerMetre = table.number("extinction_per_metre", 0, 1e6, setup.extinctionPerMetre);
    setup.shadowCells = static_cast<int>(table.integer("shadow_cells", 0, 16, setup.shadowCells));
    if (table.has("albedo")) {
        const glm::dvec3 albedo = table.vector3("albedo");
        for (int channel = 0; channel < 3; ++channel)
            if (!(albedo[channel] >= 0 && albedo[channel] <= 1))
                throw InputError(
                    fmt::format("{}key 'albedo': got {}, allowed: 0..1", table.where("albedo"), albedo[channel]));
        setup.albedo = glm::vec3(albedo);
    }
    if (const std::string fire = table.text("fire", ""); !fire.empty()) {
        setup.fire = folder / fire;
        setup.coldTemperature = table.number("cold", -1e9, 1e9);
        setup.hotTemperature = table.number("hot", -1e9, 1e9);
        if (!(setup.hotTemperature > setup.coldTemperature))
            throw InputError(fmt::format("{}key 'hot': got {}, expected more than {}, the value of 'cold'",
                                         table.where("hot"), setup.hotTemperature, setup.coldTemperature));
    }
    table.finish();
}

}  // namespace

VolumeSetup readVolumeSetup(const std::filesystem::path& path) {
    VolumeSetup setup;
    if (path.extension() != ".toml") {
        setup.files = path;
        return setup;
    }
    TomlReader file = TomlReader::parseFile(path);
    setup.description = file.text("description", "");
    setup.files = path.parent_path() / file.text("files");
    if (file.has("seconds_per_file")) setup.secondsPerFile = file.number("seconds_per_file", 1e-6, 1e6);
    readSetupPlace(file, setup);
    if (file.has("fields")) readFields(file.table("fields"), setup.fields);
    if (file.has("look")) readLook(file.table("look"), path.parent_path(), setup);
    if (file.has("particles")) {
        TomlReader table = file.table("particles");
        setup.blockCells = static_cast<int>(table.integer("block_cells", 1, 64, setup.blockCells));
        table.finish();
    }
    setup.fields.wantsTemperature = !setup.fire.empty() || !setup.fields.temperature.empty();
    file.finish();
    return setup;
}

}  // namespace dustbench::volumes
