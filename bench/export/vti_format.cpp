#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include "bench/export/exporter.h"
#include "bench/export/format_writers.h"
#include "bench/export/vtk_file.h"
#include "bench/export/whole_file.h"

namespace dustbench::exports {
namespace {

void setPlace(vtkImageData& image, const glm::dvec3& origin, double spacing, const glm::ivec3& cells) {
    image.SetOrigin(origin.x, origin.y, origin.z);
    image.SetSpacing(spacing, spacing, spacing);
    image.SetDimensions(cells.x + 1, cells.y + 1, cells.z + 1);
}

void writeImage(vtkImageData& image, const std::filesystem::path& file) {
    WholeFile whole(file);
    vtkNew<vtkXMLImageDataWriter> writer;
    writeVtk(*writer, image, whole.temporaryPath());
    whole.publish();
}

}  // namespace

void writeVti(const ExtinctionGrid& grid, const FileOrigin& origin, const std::filesystem::path& file) {
    const GridPlan& plan = grid.plan;
    vtkNew<vtkFloatArray> extinction;
    extinction->SetName("extinction");
    // VTK only reads our memory; `1`: it does not free it either.
    extinction->SetArray(const_cast<float*>(grid.extinctionPerMetre.data()), plan.cellCount(), 1);

    vtkNew<vtkImageData> image;
    setPlace(*image, plan.origin, plan.spacingMetres, {plan.cells[0], plan.cells[1], plan.cells[2]});
    image->GetCellData()->SetScalars(extinction);
    addUnit(*image, "extinction", "1/m");
    stampOrigin(*image, origin);

    writeImage(*image, file);
}

void writeGridVti(const CollectedGrid& grid, const FileOrigin& origin, const std::filesystem::path& file) {
    vtkNew<vtkImageData> image;
    setPlace(*image, grid.originMetres, grid.spacingMetres, grid.cells);
    for (const CollectedField& field : grid.fields) {
        vtkNew<vtkFloatArray> values;
        values->SetName(field.name.c_str());
        values->SetNumberOfComponents(field.components);
        // As above: VTK only reads our memory.
        values->SetArray(const_cast<float*>(field.values.data()), static_cast<vtkIdType>(field.values.size()), 1);
        image->GetCellData()->AddArray(values);
        addUnit(*image, field.name, field.unit);
    }
    if (!grid.fields.empty()) image->GetCellData()->SetActiveScalars(grid.fields.front().name.c_str());
    stampOrigin(*image, origin);
    writeImage(*image, file);
}

namespace vti_format {

Exporter describe() {
    Exporter exporter{.id = "vti",
                      .extension = "vti",
                      .kind = "grid",
                      .contents = "grid of extinction, in 1/m",
                      .programs = "ParaView, VTK",
                      .readersNeedEqualGrids = true,
                      .place = 1};
    exporter.writeGrid = [](const ExtinctionGrid& grid, const ExportedMoment& moment, ExportFolder& folder) {
        const std::string name = fileOf(moment, "vti");
        writeVti(grid, moment.origin(), folder.file(name));
        folder.addTo("extinction.pvd", Series::Kind::pvd, name, moment);
        folder.addTo("extinction.vti.series", Series::Kind::json, name, moment);
    };
    // A method's own grid with all its fields, in addition to the extinction that every cloud has.
    exporter.write = [](const ExportedMoment& moment, ExportFolder& folder) {
        if (moment.volume.grids().empty()) return;
        const std::string name = ownFileOf(moment, "vti");
        writeGridVti(moment.volume.grids().front(), moment.origin(), folder.file(name));
        folder.addTo(fmt::format("{}_grid.pvd", moment.method), Series::Kind::pvd, name, moment);
    };
    return exporter;
}

}  // namespace vti_format

}  // namespace dustbench::exports
