#include "bench/export/surface_writer.h"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <span>
#include <string>
#include <vector>

#include "bench/export/vtk_file.h"
#include "bench/export/whole_file.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {
namespace {

vtkNew<vtkFloatArray> arrayOf(const std::string& name, int components, std::span<const float> values) {
    vtkNew<vtkFloatArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    std::copy(values.begin(), values.end(), array->WritePointer(0, static_cast<vtkIdType>(values.size())));
    return array;
}

vtkNew<vtkFloatArray> arrayOf(const std::string& name, const std::vector<glm::vec3>& vectors) {
    return arrayOf(name, 3, {reinterpret_cast<const float*>(vectors.data()), 3 * vectors.size()});
}

/// Counter-clockwise as seen from the face.
vtkNew<vtkCellArray> quadrilaterals(const CollectedSurface& surface) {
    vtkNew<vtkCellArray> cells;
    cells->AllocateExact(static_cast<vtkIdType>(surface.columns - 1) * (surface.rows - 1),
                         static_cast<vtkIdType>(surface.columns - 1) * (surface.rows - 1) * 4);
    for (vtkIdType row = 0; row + 1 < surface.rows; ++row)
        for (vtkIdType column = 0; column + 1 < surface.columns; ++column) {
            const vtkIdType lower = row * surface.columns + column, upper = lower + surface.columns;
            cells->InsertNextCell({lower, lower + 1, upper + 1, upper});
        }
    return cells;
}

}  // namespace

void writeSurface(const CollectedSurface& surface, const FileOrigin& origin, const std::filesystem::path& file) {
    vtkNew<vtkPolyData> mesh;
    vtkNew<vtkPoints> points;
    points->SetData(arrayOf("position", surface.position));
    mesh->SetPoints(points);
    mesh->SetPolys(quadrilaterals(surface));
    const auto add = [&mesh](vtkFloatArray& array, const std::string& unit) {
        mesh->GetPointData()->AddArray(&array);
        addUnit(*mesh, array.GetName(), unit);
    };
    add(*arrayOf("colour", surface.colour), "linear RGB");
    add(*arrayOf("height", 1, surface.height), "1");
    for (const CollectedField& field : surface.fields)
        add(*arrayOf(field.name, field.components, field.values), field.unit);
    stampOrigin(*mesh, origin);

    WholeFile whole(file);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writeVtk(*writer, *mesh, whole.temporaryPath());
    whole.publish();
}

void writeHeights(const CollectedSurface& surface, const std::filesystem::path& file) {
    pictures::Image picture{surface.columns, surface.rows, {}};
    picture.pixels.reserve(surface.height.size());
    const auto columns = static_cast<std::size_t>(surface.columns);
    for (auto row = static_cast<std::size_t>(surface.rows); row-- > 0;)
        for (std::size_t column = 0; column < columns; ++column)
            picture.pixels.emplace_back(glm::vec3(surface.height[row * columns + column]), 1.0f);
    pictures::writeImage(picture, file);
}

void writeTexture(const CollectedTexture& texture, const std::filesystem::path& file) {
    pictures::writeImage({texture.columns, texture.rows, texture.texels}, file);
}

}  // namespace dustbench::bench
