#include "bench/export/vdb_writer.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "bench/export/whole_file.h"

namespace dustbench::bench {
namespace {

constexpr float largestHalf = 65504;

/// OpenVDB's own file object does not notice a full disk: the stream is ours, and asked.
class File final : public openvdb::io::Archive {
 public:
    void write(const std::filesystem::path& path, const openvdb::GridPtrVec& grids) const {
        std::ofstream stream(path, std::ios::binary | std::ios::trunc);
        if (!stream) throw cannotWrite(path, std::strerror(errno));
        Archive::write(stream, grids, /*seekable=*/true);
        stream.flush();
        if (!stream) throw cannotWrite(path, std::strerror(errno));
    }
};

openvdb::FloatGrid::Ptr sparse(const ExtinctionGrid& grid) {
    const GridPlan& plan = grid.plan;
    const openvdb::CoordBBox box(0, 0, 0, plan.cells[0] - 1, plan.cells[1] - 1, plan.cells[2] - 1);
    // OpenVDB's LayoutXYZ: x fastest, as ours is. It reads our memory and does not write to it.
    const openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(
        box, const_cast<float*>(grid.extinctionPerMetre.data()));
    const openvdb::FloatGrid::Ptr density = openvdb::FloatGrid::create(0);
    openvdb::tools::copyFromDense(dense, *density, 0.0f);
    const double spacing = plan.spacingMetres;
    const auto transform = openvdb::math::Transform::createLinearTransform(spacing);
    transform->postTranslate(openvdb::Vec3d(plan.origin.x, plan.origin.y, plan.origin.z) + openvdb::Vec3d(spacing / 2));
    density->setTransform(transform);
    return density;
}

}  // namespace

void writeVdb(const ExtinctionGrid& grid, VdbPrecision precision, std::int64_t frame, double timeSeconds,
              const std::filesystem::path& file) {
    const bool half = precision == VdbPrecision::half;
    const float largest = *std::ranges::max_element(grid.extinctionPerMetre);
    if (half && largest > largestHalf)
        throw InputError(
            fmt::format("{}: an extinction of {} per metre is beyond half floats, allowed: at most {}, or "
                        "--vdb-precision float",
                        file.string(), largest, largestHalf));
    openvdb::initialize();
    const openvdb::FloatGrid::Ptr density = sparse(grid);
    density->setName("density");
    density->setGridClass(openvdb::GRID_FOG_VOLUME);
    density->setSaveFloatAsHalf(half);
    density->setCreator("dustbench");
    density->insertMeta("unit", openvdb::StringMetadata("extinction per metre"));
    density->insertMeta("time_s", openvdb::DoubleMetadata(timeSeconds));
    density->insertMeta("frame", openvdb::Int64Metadata(frame));

    WholeFile whole(file);
    try {
        File().write(whole.beside(), {density});
    } catch (const openvdb::Exception& error) {
        throw cannotWrite(file, error.what());
    }
    whole.publish();
}

}  // namespace dustbench::bench
