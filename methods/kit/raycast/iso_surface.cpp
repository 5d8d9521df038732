#include "methods/kit/raycast/iso_surface.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace dustbench::raycast {
namespace {

/// Cell centres as points, in units of cells, surrounded by a layer of zeros.
void fill(vtkImageData& image, const ShownGrid& grid) {
    const glm::ivec3 size = grid.cells + 2;
    image.SetDimensions(size.x, size.y, size.z);
    image.SetOrigin(-0.5, -0.5, -0.5);
    vtkNew<vtkFloatArray> values;
    values->SetName("density");
    values->SetNumberOfTuples(static_cast<vtkIdType>(size.x) * size.y * size.z);
    std::fill_n(values->GetPointer(0), values->GetNumberOfTuples(), 0.0f);
    const float* from = grid.density.data();
    for (int z = 1; z <= grid.cells.z; ++z)
        for (int y = 1; y <= grid.cells.y; ++y, from += grid.cells.x)
            std::copy_n(from, grid.cells.x, values->GetPointer(1 + static_cast<vtkIdType>(size.x) * (y + size.y * z)));
    image.GetPointData()->SetScalars(values);
}

}  // namespace

IsoSurface isoSurface(const ShownGrid& grid, double density) {
    vtkNew<vtkImageData> image;
    fill(*image, grid);
    vtkNew<vtkFlyingEdges3D> edges;
    edges->SetInputData(image);
    edges->SetValue(0, density);
    edges->ComputeNormalsOn();
    edges->ComputeScalarsOff();
    edges->Update();
    vtkPolyData& found = *edges->GetOutput();

    IsoSurface surface;
    vtkDataArray* const normals = found.GetPointData()->GetNormals();
    if (!normals) return surface;
    surface.vertices.reserve(static_cast<std::size_t>(found.GetNumberOfPoints()));
    for (vtkIdType i = 0; i < found.GetNumberOfPoints(); ++i) {
        const double* const at = found.GetPoint(i);
        const glm::vec3 place(grid.spacingMetres * glm::dvec3(at[0], at[1], at[2]));
        const double* const normal = normals->GetTuple3(i);
        surface.vertices.push_back({place, glm::vec3(normal[0], normal[1], normal[2])});
    }
    surface.indices.reserve(3 * static_cast<std::size_t>(found.GetNumberOfPolys()));
    vtkCellArray& triangles = *found.GetPolys();
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    for (triangles.InitTraversal(); triangles.GetNextCell(count, corners);)
        for (vtkIdType i = 0; i < count; ++i) surface.indices.push_back(static_cast<std::uint32_t>(corners[i]));
    return surface;
}

}  // namespace dustbench::raycast
