#include "bench/export/format_writers.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/export/exporter.h"
#include "bench/export/vdb_library.h"
#include "bench/export/whole_file.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/loaded_library.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::exports {
namespace {

constexpr float largestHalf = 65504;
/// OpenVDB treats cells of less than 3e-15 m³ as empty.
constexpr double smallestSpacing = 1.5e-5;

/// Loaded on first call. Never unloaded, because OpenVDB uses threads.
const VdbLibrary& vdbLibrary() {
    static const VdbLibrary& library = *reinterpret_cast<const VdbLibrary* (*)()>(
        files::functionOf("dustbench_openvdb", "dustbenchVdbLibrary", "OpenVDB files"))();
    return library;
}

void writeWholeVdb(const VdbContents& contents, const std::filesystem::path& file) {
    if (contents.spacingMetres < smallestSpacing)
        throw InputError(
            fmt::format("vdb: got cells of {:.3g} m, allowed: {:.2g} m or more; choose a lower --resolution, a "
                        "larger --region or another --format",
                        contents.spacingMetres, smallestSpacing));
    WholeFile whole(file);
    if (const auto failure = vdbLibrary().write(contents, whole.temporaryPath())) {
        if (failure->message.empty()) files::failWriting(whole.temporaryPath(), failure->errorNumber);
        throw cannotWrite(file, failure->message);
    }
    whole.publish();
}

}  // namespace

void writeVdb(const ExtinctionGrid& grid, VdbPrecision precision, std::int64_t frame, double timeSeconds,
              const std::filesystem::path& file) {
    const bool half = precision == VdbPrecision::half;
    const float largest = *std::ranges::max_element(grid.extinctionPerMetre);
    if (half && largest > largestHalf)
        throw InputError(
            fmt::format("{}: an extinction of {} per metre exceeds the range of half floats, allowed: at most {}, or "
                        "--vdb-precision float",
                        file.string(), largest, largestHalf));
    const GridPlan& plan = grid.plan;
    writeWholeVdb({plan.cells,
                   plan.spacingMetres,
                   plan.origin,
                   frame,
                   timeSeconds,
                   {{.name = "density", .unit = "1/m", .half = half, .values = grid.extinctionPerMetre}}},
                  file);
}

void writeGridVdb(const CollectedGrid& grid, std::int64_t frame, double timeSeconds,
                  const std::filesystem::path& file) {
    VdbContents contents{
        {grid.cells.x, grid.cells.y, grid.cells.z}, grid.spacingMetres, grid.originMetres, frame, timeSeconds};
    for (const CollectedField& field : grid.fields)
        contents.fields.push_back(
            {.name = field.name, .unit = field.unit, .components = field.components, .values = field.values});
    writeWholeVdb(contents, file);
}

namespace vdb_format {

Exporter describe() {
    Exporter exporter{.id = "vdb",
                      .extension = "vdb",
                      .kind = "OpenVDB",
                      .contents = "the same grid as an OpenVDB fog volume",
                      .programs = "Blender, Houdini",
                      .options = {{.id = "vdb_precision",
                                   .words = {"half", "float"},
                                   .help = "precision of .vdb; default: half",
                                   .isAlwaysNamed = true}},
                      .gridTenths = 11,  // in blocks: in the worst case all cells, plus a tenth for the tree
                      .withScene = false,
                      .place = 4};
    exporter.writeGrid = [](const ExtinctionGrid& grid, const ExportedMoment& moment, ExportFolder& folder) {
        const std::string name = fileOf(moment, "vdb");
        const VdbPrecision precision =
            folder.settings().option("vdb_precision") == "half" ? VdbPrecision::half : VdbPrecision::single;
        writeVdb(grid, precision, moment.frame, moment.state.timeSeconds, folder.file(name));
        folder.addTo("density.vdb.series", Series::Kind::json, name, moment);
    };
    exporter.write = [](const ExportedMoment& moment, ExportFolder& folder) {
        if (moment.volume.grids().empty()) return;
        const std::string name = ownFileOf(moment, "vdb");
        writeGridVdb(moment.volume.grids().front(), moment.frame, moment.state.timeSeconds, folder.file(name));
        folder.addTo(fmt::format("{}_grid.vdb.series", moment.method), Series::Kind::json, name, moment);
    };
    return exporter;
}

}  // namespace vdb_format

}  // namespace dustbench::exports
