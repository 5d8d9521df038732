#include "methods/voxel_shape/voxels/voxel_file.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/volumes/vti_file.h"

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

Lattice latticeOf(const volumes::VtiFile& vti, const std::filesystem::path& file) {
    Lattice lattice;
    const glm::dvec3& spacing = vti.spacing();
    for (int axis = 0; axis < 3; ++axis) {
        lattice.counts[axis] = vti.cells()[axis];
        if (lattice.counts[axis] > maximumVoxelsASide)
            fail(file, "got " + std::to_string(lattice.counts[axis]) + " voxels along one side, allowed: 1.." +
                           std::to_string(maximumVoxelsASide));
        if (!(spacing[axis] > 0) || !(std::abs(spacing[axis] / spacing.x - 1) <= 1e-5))
            fail(file, "got voxels of " + std::to_string(spacing.x) + " x " + std::to_string(spacing.y) + " x " +
                           std::to_string(spacing.z) + " m, expected cubes");
        lattice.origin[axis] = static_cast<float>(vti.origin()[axis]);
    }
    lattice.edgeMetres = static_cast<float>(spacing.x);
    return lattice;
}

void readAttribute(const Attribute& attribute, const volumes::VtiFile& vti, VoxelGrid& grid,
                   const std::filesystem::path& file) {
    const volumes::VtiArray* const array = vti.cellArray(attribute.name);
    const std::size_t cells = grid.lattice().size();
    if (!array || array->components != attribute.components)
        fail(file, "cell data '" + std::string(attribute.name) + "': expected " + std::to_string(attribute.components) +
                       " numbers for each of " + std::to_string(cells) + " voxels");
    const std::vector<float> numbers = vti.numbersOf(*array);
    const auto components = static_cast<std::size_t>(attribute.components);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (const auto value = static_cast<double>(numbers[i]);
            !(value >= attribute.minimum && value <= attribute.maximum))
            fail(file, "cell data '" + std::string(attribute.name) + "': voxel " + std::to_string(i / components) +
                           " has " + std::to_string(value) + ", allowed: " + std::to_string(attribute.minimum) + ".." +
                           std::to_string(attribute.maximum));
    for (std::size_t i = 0; i < cells; ++i) attribute.set(grid.voxels()[i], &numbers[i * components]);
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
    const volumes::VtiFile vti(file);
    files::noteInput(file);
    const std::optional<double> version = vti.fieldNumber(versionName);
    if (!version) fail(file, std::string("not a dustbench voxel file: it has no field data '") + versionName + "'");
    if (*version != voxelFileVersion)
        fail(file, fmt::format("voxels of version {}, allowed: {}", *version, voxelFileVersion));
    VoxelGrid grid(ledger, latticeOf(vti, file));
    for (const Attribute& attribute : attributes) readAttribute(attribute, vti, grid, file);
    grid.listActive();
    return grid;
}

}  // namespace dustbench::voxel_shape
