#include "bench/export/vti_writer.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

#include "bench/export/vtk_file.h"
#include "bench/export/whole_file.h"

namespace dustbench::bench {

void writeVti(const ExtinctionGrid& grid, double timeSeconds, const std::filesystem::path& file) {
    const GridPlan& plan = grid.plan;
    vtkNew<vtkFloatArray> extinction;
    extinction->SetName("extinction");
    // VTK reads our memory and does not write to it; `1`: nor does it free it.
    extinction->SetArray(const_cast<float*>(grid.extinctionPerMetre.data()), plan.cellCount(), 1);

    vtkNew<vtkImageData> image;
    image->SetOrigin(plan.origin.x, plan.origin.y, plan.origin.z);
    image->SetSpacing(plan.spacingMetres, plan.spacingMetres, plan.spacingMetres);
    image->SetDimensions(plan.cells[0] + 1, plan.cells[1] + 1, plan.cells[2] + 1);
    image->GetCellData()->SetScalars(extinction);
    stampTime(*image, timeSeconds);

    WholeFile whole(file);
    vtkNew<vtkXMLImageDataWriter> writer;
    writeVtk(*writer, *image, whole.beside());
    whole.publish();
}

}  // namespace dustbench::bench
