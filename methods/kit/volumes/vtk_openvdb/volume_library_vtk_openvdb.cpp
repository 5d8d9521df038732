// Implements the volume library with VTK and OpenVDB.
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>

#include <cmath>
#include <fstream>

#ifdef __SANITIZE_THREAD__
#include <tbb/global_control.h>
#endif

#include "methods/kit/volumes/volume_library.h"
#include "methods/kit/volumes/vti_check.h"

namespace dustbench::volumes {
namespace {

constexpr double cubeWithin = 1e-5;

/// Collects VTK's errors, which would go to standard error.
class Complaints {
 public:
    Complaints() {
        command_->SetClientData(this);
        command_->SetCallback(
            [](vtkObject*, unsigned long, void* client, void*) { static_cast<Complaints*>(client)->any_ = true; });
    }
    void listenTo(vtkXMLReader& reader) {
        reader.AddObserver("ErrorEvent", command_);
        reader.AddObserver("WarningEvent", command_);
        reader.SetReaderErrorObserver(command_);
        reader.SetParserErrorObserver(command_);
        if (vtkExecutive* const executive = reader.GetExecutive()) executive->AddObserver("ErrorEvent", command_);
    }
    [[nodiscard]] bool any() const { return any_; }

 private:
    vtkNew<vtkCallbackCommand> command_;
    bool any_ = false;
};

std::string noField(const std::string& field, const std::string& others) {
    return "it has no field of vectors '" + field + "'" + (others.empty() ? "" : "; it has: " + others);
}

std::string readVti(const std::filesystem::path& file, const std::string& field, VectorGrid& grid) {
    Complaints complaints;
    vtkNew<vtkXMLImageDataReader> reader;
    complaints.listenTo(*reader);
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkImageData* const image = reader->GetOutput();
    if (complaints.any() || !image || image->GetNumberOfCells() == 0) return "not a whole file of VTK's image data";
    vtkDataArray* const vectors = image->GetCellData()->GetArray(field.c_str());
    if (!vectors || vectors->GetNumberOfComponents() != 3) {
        std::string others;
        for (int i = 0; i < image->GetCellData()->GetNumberOfArrays(); ++i)
            if (image->GetCellData()->GetArray(i) && image->GetCellData()->GetArray(i)->GetNumberOfComponents() == 3)
                others += (others.empty() ? "" : ", ") + std::string(image->GetCellData()->GetArrayName(i));
        return noField(field, others);
    }
    const double* const spacing = image->GetSpacing();
    for (int axis = 0; axis < 3; ++axis) {
        if (!(spacing[axis] > 0) || std::abs(spacing[axis] / spacing[0] - 1) > cubeWithin)
            return "its cells are no cubes";
        grid.cells[axis] = image->GetDimensions()[axis] - 1;
        grid.origin[axis] = image->GetOrigin()[axis] + image->GetExtent()[2 * axis] * spacing[axis];
    }
    if (grid.cells.x < 1 || grid.cells.y < 1 || grid.cells.z < 1)
        return "it is flat, expected cells in three directions";
    grid.spacing = spacing[0];
    if (vtkDataArray* const time = image->GetFieldData()->GetArray("TimeValue"); time && time->GetNumberOfTuples() == 1)
        grid.timeSeconds = time->GetComponent(0, 0);
    grid.values.resize(static_cast<std::size_t>(vectors->GetNumberOfTuples()));
    for (std::size_t i = 0; i < grid.values.size(); ++i)
        for (int c = 0; c < 3; ++c)
            grid.values[i][c] = static_cast<float>(vectors->GetComponent(static_cast<vtkIdType>(i), c));
    return "";
}

std::string copyDense(const openvdb::Vec3SGrid& stored, VectorGrid& grid) {
    const openvdb::CoordBBox box = stored.evalActiveVoxelBoundingBox();
    if (!stored.transform().isLinear() || !stored.hasUniformVoxels()) return "its cells are no cubes";
    if (box.empty()) return "its vectors are zero everywhere";
    if (static_cast<std::int64_t>(box.volume()) > maximumCells) return "it has more than 256 million cells";
    openvdb::tools::Dense<openvdb::Vec3s, openvdb::tools::LayoutXYZ> dense(box);
    openvdb::tools::copyToDense(stored, dense);
    grid.spacing = stored.voxelSize()[0];
    const openvdb::Vec3d first = stored.indexToWorld(box.min());  // the centre of the first cell
    for (int axis = 0; axis < 3; ++axis) {
        grid.cells[axis] = box.dim()[axis];
        grid.origin[axis] = first[axis] - grid.spacing / 2;
    }
    grid.values.resize(static_cast<std::size_t>(box.volume()));
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
        const openvdb::Vec3s& v = dense.data()[i];
        grid.values[i] = {v.x(), v.y(), v.z()};
    }
    return "";
}

std::string readVdb(const std::filesystem::path& file, const std::string& field, VectorGrid& grid) {
#ifdef __SANITIZE_THREAD__
    // ThreadSanitizer cannot see into an uninstrumented oneTBB.
    static const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
#endif
    openvdb::initialize();
    try {
        // OpenVDB does not detect a truncated file and continues with what is in memory; the stream detects the end.
        std::ifstream stream(file, std::ios::binary);
        stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
        openvdb::io::Stream stored(stream, /*delayLoad=*/false);
        openvdb::Vec3SGrid::Ptr vectors;
        std::string others;
        for (const openvdb::GridBase::Ptr& each : *stored.getGrids()) {
            const auto found = openvdb::gridPtrCast<openvdb::Vec3SGrid>(each);
            if (!found) continue;
            if (found->getName() == field) vectors = found;
            others += (others.empty() ? "" : ", ") + found->getName();
        }
        if (!vectors) return noField(field, others);
        if (const auto time = vectors->getMetadata<openvdb::DoubleMetadata>("time_s")) grid.timeSeconds = time->value();
        grid.sparse = true;
        return copyDense(*vectors, grid);
    } catch (const std::exception&) {
        return "not a whole file of OpenVDB";
    }
}

class VtkOpenVdb final : public VolumeLibrary {
 public:
    std::string readVectors(const std::filesystem::path& file, const std::string& field,
                            VectorGrid& grid) const override {
        if (std::filesystem::is_directory(file) || !std::ifstream(file)) return "it cannot be read";
        grid = {};
        if (file.extension() == ".vti") return readValid(readVti(file, field, grid), grid);
        if (file.extension() == ".vdb") return readValid(readVdb(file, field, grid), grid);
        return "expected a file that ends in .vti or .vdb";
    }

 private:
    static std::string readValid(const std::string& reason, const VectorGrid& grid) {
        if (!reason.empty()) return reason;
        for (const glm::vec3& v : grid.values)
            if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
                return "it has a vector that is no number";
        return "";
    }
};

}  // namespace
}  // namespace dustbench::volumes

extern "C" DUSTBENCH_API const dustbench::volumes::VolumeLibrary* dustbenchVolumeLibrary();
extern "C" const dustbench::volumes::VolumeLibrary* dustbenchVolumeLibrary() {
    static const dustbench::volumes::VtkOpenVdb library;
    return &library;
}
