#include "bench/export/format_writers.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#ifdef __SANITIZE_THREAD__
#include <tbb/global_control.h>
#endif

#include "bench/export/exporter.h"
#include "bench/export/whole_file.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::exports {
namespace {

constexpr float largestHalf = 65504;

/// ThreadSanitizer cannot see into an uninstrumented oneTBB and reports false races: OpenVDB uses one thread there.
void initialise() {
#ifdef __SANITIZE_THREAD__
    static const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
#endif
    openvdb::initialize();
}

/// OpenVDB's own file class does not notice a full disk, so we open the stream and check it.
class File final : public openvdb::io::Archive {
 public:
    void writeFile(const std::filesystem::path& path, const openvdb::GridPtrVec& grids) const {
        std::ofstream stream(path, std::ios::binary | std::ios::trunc);
        if (!stream) files::failWriting(path, errno);
        Archive::write(stream, grids, /*seekable=*/true);
        stream.flush();
        if (!stream) files::failWriting(path, errno);
    }
};

/// `values` cell by cell, x fastest, which is OpenVDB's LayoutXYZ. OpenVDB only reads our memory.
template <typename Grid>
typename Grid::Ptr sparse(const float* values, const std::array<int, 3>& cells, double spacing,
                          const glm::dvec3& origin) {
    using Value = typename Grid::ValueType;
    const openvdb::CoordBBox box(0, 0, 0, cells[0] - 1, cells[1] - 1, cells[2] - 1);
    const openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(
        box, reinterpret_cast<Value*>(const_cast<float*>(values)));
    const auto grid = Grid::create(Value(0));
    openvdb::tools::copyFromDense(dense, *grid, Value(0));
    // OpenVDB treats cells of less than 3e-15 m³ as empty.
    constexpr double smallestSpacing = 1.5e-5;
    if (spacing < smallestSpacing)
        throw InputError(
            fmt::format("vdb: got cells of {:.3g} m, allowed: {:.2g} m or more; choose a lower --resolution, a "
                        "larger --region or another --format",
                        spacing, smallestSpacing));
    const auto transform = openvdb::math::Transform::createLinearTransform(spacing);
    transform->postTranslate(openvdb::Vec3d(origin.x, origin.y, origin.z) + openvdb::Vec3d(spacing / 2));
    grid->setTransform(transform);
    return grid;
}

void describe(openvdb::GridBase& grid, const std::string& name, const std::string& unit, std::int64_t frame,
              double timeSeconds) {
    grid.setName(name);
    grid.setCreator("dustbench");
    grid.insertMeta("unit", openvdb::StringMetadata(unit));
    grid.insertMeta("time_s", openvdb::DoubleMetadata(timeSeconds));
    grid.insertMeta("frame", openvdb::Int64Metadata(frame));
}

void writeWholeVdb(const openvdb::GridPtrVec& grids, const std::filesystem::path& file) {
    WholeFile whole(file);
    try {
        File().writeFile(whole.temporaryPath(), grids);
    } catch (const openvdb::Exception& error) {
        throw cannotWrite(file, error.what());
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
    initialise();
    const GridPlan& plan = grid.plan;
    const auto density =
        sparse<openvdb::FloatGrid>(grid.extinctionPerMetre.data(), plan.cells, plan.spacingMetres, plan.origin);
    density->setGridClass(openvdb::GRID_FOG_VOLUME);
    density->setSaveFloatAsHalf(half);
    describe(*density, "density", "1/m", frame, timeSeconds);
    writeWholeVdb({density}, file);
}

void writeGridVdb(const CollectedGrid& grid, std::int64_t frame, double timeSeconds,
                  const std::filesystem::path& file) {
    initialise();
    const std::array cells{grid.cells.x, grid.cells.y, grid.cells.z};
    openvdb::GridPtrVec grids;
    for (const CollectedField& field : grid.fields) {
        openvdb::GridBase::Ptr each;
        if (field.components == 3) {
            const auto vectors =
                sparse<openvdb::Vec3SGrid>(field.values.data(), cells, grid.spacingMetres, grid.originMetres);
            vectors->setVectorType(openvdb::VEC_CONTRAVARIANT_ABSOLUTE);
            each = vectors;
        } else {
            each = sparse<openvdb::FloatGrid>(field.values.data(), cells, grid.spacingMetres, grid.originMetres);
            each->setGridClass(openvdb::GRID_FOG_VOLUME);
        }
        describe(*each, field.name, field.unit, frame, timeSeconds);
        grids.push_back(each);
    }
    writeWholeVdb(grids, file);
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
