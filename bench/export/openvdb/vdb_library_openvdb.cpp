#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <cerrno>
#include <fstream>

#ifdef __SANITIZE_THREAD__
#include <tbb/global_control.h>
#endif

#include "bench/export/vdb_library.h"

namespace dustbench::exports {
namespace {
namespace fs = std::filesystem;

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
    [[nodiscard]] std::optional<VdbFailure> writeFile(const fs::path& path, const openvdb::GridPtrVec& grids) const {
        std::ofstream stream(path, std::ios::binary | std::ios::trunc);
        if (!stream) return VdbFailure{.errorNumber = errno};
        Archive::write(stream, grids, /*seekable=*/true);
        stream.flush();
        if (!stream) return VdbFailure{.errorNumber = errno};
        return {};
    }
};

/// `values` cell by cell, x fastest, which is OpenVDB's LayoutXYZ. OpenVDB only reads our memory.
template <typename Grid>
typename Grid::Ptr sparse(const VdbField& field, const VdbContents& contents) {
    using Value = typename Grid::ValueType;
    const auto& cells = contents.cells;
    const openvdb::CoordBBox box(0, 0, 0, cells[0] - 1, cells[1] - 1, cells[2] - 1);
    const openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(
        box, reinterpret_cast<Value*>(const_cast<float*>(field.values.data())));
    const auto grid = Grid::create(Value(0));
    openvdb::tools::copyFromDense(dense, *grid, Value(0));
    const auto transform = openvdb::math::Transform::createLinearTransform(contents.spacingMetres);
    const glm::dvec3& origin = contents.originMetres;
    transform->postTranslate(openvdb::Vec3d(origin.x, origin.y, origin.z) + openvdb::Vec3d(contents.spacingMetres / 2));
    grid->setTransform(transform);
    return grid;
}

openvdb::GridBase::Ptr gridOf(const VdbField& field, const VdbContents& contents) {
    if (field.components == 3) {
        const auto vectors = sparse<openvdb::Vec3SGrid>(field, contents);
        vectors->setVectorType(openvdb::VEC_CONTRAVARIANT_ABSOLUTE);
        return vectors;
    }
    const auto fog = sparse<openvdb::FloatGrid>(field, contents);
    fog->setGridClass(openvdb::GRID_FOG_VOLUME);
    return fog;
}

class OpenVdb final : public VdbLibrary {
 public:
    [[nodiscard]] std::optional<VdbFailure> write(const VdbContents& contents, const fs::path& file) const override
        try {
        initialise();
        openvdb::GridPtrVec grids;
        for (const VdbField& field : contents.fields) {
            const openvdb::GridBase::Ptr grid = grids.emplace_back(gridOf(field, contents));
            grid->setSaveFloatAsHalf(field.half);
            grid->setName(field.name);
            grid->setCreator("dustbench");
            grid->insertMeta("unit", openvdb::StringMetadata(field.unit));
            grid->insertMeta("time_s", openvdb::DoubleMetadata(contents.timeSeconds));
            grid->insertMeta("frame", openvdb::Int64Metadata(contents.frame));
        }
        return File().writeFile(file, grids);
    } catch (const openvdb::Exception& error) {
        return VdbFailure{.message = error.what()};
    }
};

}  // namespace
}  // namespace dustbench::exports

extern "C" DUSTBENCH_API const dustbench::exports::VdbLibrary* dustbenchVdbLibrary();
extern "C" const dustbench::exports::VdbLibrary* dustbenchVdbLibrary() {
    static const dustbench::exports::OpenVdb library;
    return &library;
}
