#include "methods/voxel_shape/voxels/voxel_file.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>

#include <cmath>
#include <fstream>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/vti_check.h"

namespace dustbench::voxel_shape {
namespace {

constexpr const char* versionName = "dustbench_voxels";

/// An attribute: its name in the file, number of components, range, and accessors.
struct Attribute {
    const char* name;
    int components;
    double minimum, maximum;
    float (*get)(const Voxel& voxel, int component);
    void (*set)(Voxel& voxel, const float* numbers);
};

float fileNumber(const Voxel& voxel) {
    return voxel.forceKind() == Force::spiral ? voxel.forceNumber * glm::length(voxel.force) : voxel.forceNumber;
}

/// `force` must follow `force_kind` and `force_number`, which it needs.
constexpr Attribute attributes[]{
    {"active", 1, 0, 1, [](const Voxel& v, int) { return v.isActive() ? 1.0f : 0.0f; },
     [](Voxel& v, const float* n) { v.setActive(n[0] >= 0.5f); }},
    {"colour", 4, 0, 1, [](const Voxel& v, int c) { return v.colour.colour()[c]; },
     [](Voxel& v, const float* n) {
         v.colour = PackedColour({n[0], n[1], n[2], n[3]});
     }},
    {"fading_colour", 4, 0, 1, [](const Voxel& v, int c) { return v.fadingColour.colour()[c]; },
     [](Voxel& v, const float* n) {
         v.fadingColour = PackedColour({n[0], n[1], n[2], n[3]});
     }},
    {"size_metres", 1, 0, 1e4, [](const Voxel& v, int) { return v.sizeMetres; },
     [](Voxel& v, const float* n) { v.sizeMetres = n[0]; }},
    {"fading_size_metres", 1, 0, 1e4, [](const Voxel& v, int) { return v.fadingSizeMetres; },
     [](Voxel& v, const float* n) { v.fadingSizeMetres = n[0]; }},
    {"lifetime_seconds", 1, 0, 1e4, [](const Voxel& v, int) { return v.lifetimeSeconds; },
     [](Voxel& v, const float* n) { v.lifetimeSeconds = n[0]; }},
    {"interpolation_seconds", 1, 0, 1e4, [](const Voxel& v, int) { return v.interpolationSeconds; },
     [](Voxel& v, const float* n) { v.interpolationSeconds = n[0]; }},
    {"pictures_per_second", 1, 0, 1e4, [](const Voxel& v, int) { return v.picturesPerSecond; },
     [](Voxel& v, const float* n) { v.picturesPerSecond = n[0]; }},
    {"maximum_density", 1, 0, 1e7, [](const Voxel& v, int) { return static_cast<float>(v.maximumDensity); },
     [](Voxel& v, const float* n) { v.maximumDensity = static_cast<std::uint32_t>(std::lround(n[0])); }},
    {"density", 1, 0, 1e9, [](const Voxel& v, int) { return static_cast<float>(v.density); },
     [](Voxel&, const float*) {}},
    {"force_kind", 1, 0, 4, [](const Voxel& v, int) { return static_cast<float>(v.forceKind()); },
     [](Voxel& v, const float* n) { v.setForce(static_cast<Force>(std::lround(n[0])), {}, 0); }},
    {"force_number", 1, -1e4, 1e4, [](const Voxel& v, int) { return fileNumber(v); },
     [](Voxel& v, const float* n) { v.forceNumber = n[0]; }},
    {"force", 3, -1e4, 1e4, [](const Voxel& v, int c) { return v.force[c]; },
     [](Voxel& v, const float* n) {
         v.setForce(v.forceKind(), {n[0], n[1], n[2]}, v.forceNumber);
     }},
};

/// Catches VTK's errors and warnings, which would otherwise go to standard error.
class Complaints {
 public:
    Complaints() {
        command_->SetClientData(this);
        command_->SetCallback(
            [](vtkObject*, unsigned long, void* client, void*) { static_cast<Complaints*>(client)->any_ = true; });
    }
    [[nodiscard]] vtkCommand* command() { return command_; }
    [[nodiscard]] bool any() const { return any_; }

 private:
    vtkNew<vtkCallbackCommand> command_;
    bool any_ = false;
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
    throw InputError(file.string() + ": " + what);
}

Lattice latticeOf(vtkImageData& image, const std::filesystem::path& file) {
    Lattice lattice;
    const double* const spacing = image.GetSpacing();
    for (int axis = 0; axis < 3; ++axis) {
        lattice.counts[axis] = image.GetDimensions()[axis] - 1;
        if (lattice.counts[axis] < 1 || lattice.counts[axis] > maximumVoxelsASide)
            fail(file, "got " + std::to_string(lattice.counts[axis]) + " voxels along one side, allowed: 1.." +
                           std::to_string(maximumVoxelsASide));
        if (!(spacing[axis] > 0) || std::abs(spacing[axis] / spacing[0] - 1) > 1e-5)
            fail(file, "the voxels are not cubes: got spacings of " + std::to_string(spacing[0]) + ", " +
                           std::to_string(spacing[1]) + ", " + std::to_string(spacing[2]));
        lattice.origin[axis] =
            static_cast<float>(image.GetOrigin()[axis] + image.GetExtent()[2 * axis] * spacing[axis]);
    }
    lattice.edgeMetres = static_cast<float>(spacing[0]);
    return lattice;
}

void readAttribute(const Attribute& attribute, vtkImageData& image, VoxelGrid& grid,
                   const std::filesystem::path& file) {
    vtkDataArray* const array = image.GetCellData()->GetArray(attribute.name);
    const auto cells = static_cast<vtkIdType>(grid.lattice().size());
    if (!array || array->GetNumberOfComponents() != attribute.components || array->GetNumberOfTuples() != cells)
        fail(file, "cell data '" + std::string(attribute.name) + "': expected " + std::to_string(attribute.components) +
                       " numbers for each of " + std::to_string(cells) + " voxels");
    for (vtkIdType i = 0; i < cells; ++i) {
        float numbers[4];
        for (int c = 0; c < attribute.components; ++c) {
            const double value = array->GetComponent(i, c);
            if (!(value >= attribute.minimum && value <= attribute.maximum))
                fail(file, "cell data '" + std::string(attribute.name) + "': voxel " + std::to_string(i) + " has " +
                               std::to_string(value) + ", allowed: " + std::to_string(attribute.minimum) + ".." +
                               std::to_string(attribute.maximum));
            numbers[c] = static_cast<float>(value);
        }
        attribute.set(grid.voxels()[static_cast<std::size_t>(i)], numbers);
    }
}

}  // namespace

void writeVoxels(const VoxelGrid& grid, const std::filesystem::path& file) {
    const Lattice& lattice = grid.lattice();
    vtkNew<vtkImageData> image;
    image->SetDimensions(lattice.counts.x + 1, lattice.counts.y + 1, lattice.counts.z + 1);
    image->SetOrigin(static_cast<double>(lattice.origin.x), static_cast<double>(lattice.origin.y),
                     static_cast<double>(lattice.origin.z));
    const auto edge = static_cast<double>(lattice.edgeMetres);
    image->SetSpacing(edge, edge, edge);
    for (const Attribute& attribute : attributes) {
        vtkNew<vtkFloatArray> array;
        array->SetName(attribute.name);
        array->SetNumberOfComponents(attribute.components);
        array->SetNumberOfTuples(static_cast<vtkIdType>(lattice.size()));
        for (std::size_t i = 0; i < lattice.size(); ++i)
            for (int c = 0; c < attribute.components; ++c)
                array->SetTypedComponent(static_cast<vtkIdType>(i), c, attribute.get(grid.voxels()[i], c));
        image->GetCellData()->AddArray(array);
    }
    vtkNew<vtkIntArray> version;
    version->SetName(versionName);
    version->InsertNextValue(voxelFileVersion);
    image->GetFieldData()->AddArray(version);

    const std::filesystem::path part = file.string() + ".part";
    Complaints complaints;
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->AddObserver("ErrorEvent", complaints.command());
    writer->SetFileName(part.c_str());
    writer->SetInputData(image);
    std::error_code error;
    if (!std::ofstream(part) || writer->Write() == 0 || complaints.any())
        error = std::make_error_code(std::errc::io_error);
    else
        std::filesystem::rename(part, file, error);
    if (error) {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        fail(file, "the voxels cannot be written there");
    }
}

VoxelGrid readVoxels(MemoryLedger& ledger, const std::filesystem::path& file) {
    if (const std::string why = files::refusalOf(file, files::limits::geometryBytes); !why.empty()) fail(file, why);
    if (const std::string why = volumes::vtiFault(file); !why.empty())
        fail(file, "not a complete VTK image data file (.vti): " + why);
    files::noteInput(file);
    Complaints complaints;
    vtkNew<vtkXMLImageDataReader> reader;
    reader->AddObserver("ErrorEvent", complaints.command());
    reader->AddObserver("WarningEvent", complaints.command());
    reader->SetReaderErrorObserver(complaints.command());
    reader->SetParserErrorObserver(complaints.command());
    if (vtkExecutive* const executive = reader->GetExecutive())
        executive->AddObserver("ErrorEvent", complaints.command());
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkImageData* const image = reader->GetOutput();
    if (complaints.any() || !image || image->GetNumberOfCells() == 0)
        fail(file, "not a complete VTK image data file (.vti)");
    vtkDataArray* const version = image->GetFieldData()->GetArray(versionName);
    if (!version || version->GetNumberOfTuples() != 1)
        fail(file, std::string("not a dustbench voxel file: it has no field data '") + versionName + "'");
    if (version->GetComponent(0, 0) != voxelFileVersion)
        fail(file, "voxels of version " + std::to_string(std::lround(version->GetComponent(0, 0))) +
                       ", allowed: " + std::to_string(voxelFileVersion));
    VoxelGrid grid(ledger, latticeOf(*image, file));
    for (const Attribute& attribute : attributes) readAttribute(attribute, *image, grid, file);
    grid.listActive();
    return grid;
}

}  // namespace dustbench::voxel_shape
