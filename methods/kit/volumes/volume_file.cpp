#include "methods/kit/volumes/volume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/field_request.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/vti_file.h"

namespace dustbench::volumes {
namespace {

constexpr double cubeWithin = 1e-5;
/// Of the maximum: what a density may lie below zero and counts as zero, for schemes of simulations overshoot.
constexpr float belowZero = 1e-3f;
constexpr double farthest = 1e9;

InputError refused(const std::filesystem::path& file, const std::string& reason) {
    return InputError(fmt::format("{}: {}", file.string(), files::printable(reason)));
}

struct Clause {
    std::string reason;
};

struct Named {
    std::string name;
    int components = 1;
};

void takeField(const VtiFile& vti, const std::vector<VtiArray>& arrays, const WantedField& wanted, VolumeGrid& grid) {
    std::vector<Named> present;
    present.reserve(arrays.size());
    for (const VtiArray& array : arrays) present.push_back({array.name, array.components});
    const int at = chosenField<Clause>(wanted, present);
    if (at < 0) return;
    std::vector<float> numbers = vti.numbersOf(arrays[static_cast<std::size_t>(at)]);
    if (wanted.components == 1) {
        (wanted.what == "density" ? grid.density : grid.temperature) = std::move(numbers);
        return;
    }
    grid.velocity.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        grid.velocity.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
}

VolumeGrid readVti(const std::filesystem::path& file, const VolumeFields& fields) {
    const VtiFile vti(file);
    VolumeGrid grid;
    grid.cells = vti.cells();
    grid.origin = vti.origin();
    grid.spacing = vti.spacing().x;
    for (int axis = 0; axis < 3; ++axis)
        if (!(vti.spacing()[axis] > 0) || std::abs(vti.spacing()[axis] / grid.spacing - 1) > cubeWithin)
            throw refused(file, fmt::format("its cells are no cubes: {} x {} x {}", vti.spacing().x, vti.spacing().y,
                                            vti.spacing().z));
    const bool atPoints = vti.cellArrays().empty();
    if (atPoints) {
        grid.cells += 1;
        grid.origin -= grid.spacing / 2;
    }
    grid.timeSeconds = vti.fieldNumber("TimeValue");
    try {
        for (const WantedField& wanted : wantedFields(fields))
            takeField(vti, atPoints ? vti.pointArrays() : vti.cellArrays(), wanted, grid);
    } catch (const Clause& clause) {
        throw refused(file, clause.reason);
    }
    return grid;
}

VolumeGrid readSparse(const std::filesystem::path& file, const VolumeFields& fields) {
    if (const std::string why = files::refusalOf(file, files::limits::geometryBytes); !why.empty())
        throw refused(file, why);
    VolumeGrid grid;
    if (const std::string why = readVdbVolume(file, fields, grid); !why.empty()) throw refused(file, why);
    return grid;
}

void requireSound(VolumeGrid& grid, const std::filesystem::path& file, bool clampsDensity) {
    for (const double number :
         {grid.spacing, grid.origin.x, grid.origin.y, grid.origin.z, grid.timeSeconds.value_or(0)})
        if (!std::isfinite(number) || std::abs(number) > farthest)
            throw refused(file, "its place or its time is no number up to 1e9");
    float maximum = 0;
    for (const float density : grid.density) {
        if (!std::isfinite(density)) throw refused(file, "it has a density that is no number");
        maximum = std::max(maximum, density);
    }
    for (float& density : grid.density) {
        if (density >= 0) continue;
        if (density < -belowZero * maximum && !clampsDensity)
            throw refused(
                file, fmt::format("it has a density of {}, allowed: 0 or more, or clamp_density in a .toml", density));
        density = 0;
    }
    if (std::ranges::any_of(grid.temperature, [](float number) { return !std::isfinite(number); }))
        throw refused(file, "it has a temperature that is no number");
    for (const glm::vec3& v : grid.velocity)
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            throw refused(file, "it has a velocity that is no number");
}

}  // namespace

VolumeGrid readVolume(const std::filesystem::path& file, const VolumeFields& fields) {
    const std::string extension = file.extension();
    if (extension != ".vti" && extension != ".vdb" && extension != ".nvdb")
        throw refused(file, "expected a file that ends in .vdb, .nvdb or .vti");
    VolumeGrid grid = extension == ".vti" ? readVti(file, fields) : readSparse(file, fields);
    requireSound(grid, file, fields.clampsDensity);
    return grid;
}

}  // namespace dustbench::volumes
