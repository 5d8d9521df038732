#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeUInt64Array.h>
#include <vtkXMLPolyDataWriter.h>

#include <cctype>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/export/exporter.h"
#include "bench/export/format_writers.h"
#include "bench/export/vtk_file.h"
#include "bench/export/whole_file.h"
#include "methods/contract/volume.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::exports {
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

vtkNew<vtkFloatArray> interleaved(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
    vtkNew<vtkFloatArray> tuples;
    tuples->SetNumberOfComponents(3);
    float* value = tuples->WritePointer(0, static_cast<vtkIdType>(3 * x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) {
        *value++ = x[i];
        *value++ = y[i];
        *value++ = z[i];
    }
    return tuples;
}

/// A name in a form that is valid within a file name.
std::string fileWord(std::string name) {
    for (char& letter : name)
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
    return name;
}

/// `METHOD_NAME`, unlike all in `parts`: names may differ only in replaced characters.
std::string newPart(const ExportedMoment& moment, const std::string& name, std::set<std::string>& parts) {
    std::string part = fmt::format("{}_{}", moment.method, fileWord(name));
    while (!parts.insert(part).second) part += '_';
    return part;
}

/// Writes each surface that the method changes, in addition to its own particles.
void writeSurfaces(const ExportedMoment& moment, ExportFolder& folder) {
    std::set<std::string> parts;
    for (const CollectedSurface& surface : moment.volume.surfaces()) {
        const std::string part = newPart(moment, surface.name, parts);
        const std::string mesh = fmt::format("f{:06}_{}.vtp", moment.frame, part);
        writeSurface(surface, moment.origin(), folder.file(mesh));
        folder.addTo(part + ".pvd", Series::Kind::pvd, mesh, moment);
        const std::string heights = fmt::format("f{:06}_{}_heights.exr", moment.frame, part);
        writeHeights(surface, folder.file(heights));
        folder.addTo(part + "_heights.exr.series", Series::Kind::json, heights, moment);
    }
}

/// Writes the textures that hold the method's state.
void writeTextures(const ExportedMoment& moment, ExportFolder& folder) {
    std::set<std::string> parts;
    for (const CollectedTexture& texture : moment.volume.textures()) {
        const std::string part = newPart(moment, texture.name, parts);
        const std::string name = fmt::format("f{:06}_{}.exr", moment.frame, part);
        writeTexture(texture, folder.file(name));
        folder.addTo(part + ".exr.series", Series::Kind::json, name, moment);
    }
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

void writeVtp(const Puffs& dust, const FileOrigin& origin, const std::filesystem::path& file,
              std::span<const int> systems) {
    const auto count = static_cast<vtkIdType>(dust.size());
    vtkNew<vtkPolyData> cloud;
    vtkNew<vtkPoints> points;
    points->SetData(interleaved(dust.x, dust.y, dust.z));
    cloud->SetPoints(points);
    // One vertex per particle: points without cells are not drawn.
    vtkNew<vtkCellArray> vertices;
    vertices->AllocateExact(count, count);
    for (vtkIdType i = 0; i < count; ++i) vertices->InsertNextCell(1, &i);
    cloud->SetVerts(vertices);

    vtkNew<vtkTypeUInt64Array> serial;
    serial->SetName("serial");
    serial->SetNumberOfValues(count);
    std::copy(dust.serial.begin(), dust.serial.end(), serial->GetPointer(0));
    cloud->GetPointData()->AddArray(serial);
    const auto add = [&](const char* name, const char* unit, vtkFloatArray& values) {
        values.SetName(name);
        cloud->GetPointData()->AddArray(&values);
        addUnit(*cloud, name, unit);
    };
    const auto addColumn = [&](const char* name, const char* unit, std::span<const float> column) {
        vtkNew<vtkFloatArray> values;
        values->SetArray(const_cast<float*>(column.data()), count, 1);
        add(name, unit, *values);
    };
    addColumn("age", "s", dust.age);
    addColumn("lifetime", "s", dust.lifetime);
    addColumn("radius", "m", dust.radius);
    addColumn("opacity", "1", dust.opacity);
    add("velocity", "m/s", *interleaved(dust.velocityX, dust.velocityY, dust.velocityZ));
    if (!dust.uniformColour) add("colour", "linear RGB", *interleaved(dust.red, dust.green, dust.blue));
    if (!systems.empty()) {
        vtkNew<vtkIntArray> numbers;
        numbers->SetName("system");
        numbers->SetArray(const_cast<int*>(systems.data()), count, 1);
        cloud->GetPointData()->AddArray(numbers);
        addUnit(*cloud, "system", "1");
    }
    stampOrigin(*cloud, origin);

    WholeFile whole(file);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writeVtk(*writer, *cloud, whole.temporaryPath());
    whole.publish();
}

namespace vtp_format {

Exporter describe() {
    Exporter exporter{
        .id = "vtp",
        .extension = "vtp",
        .kind = "particles",
        .contents =
            "the particles that the method shows; with `relief` also the worn surfaces, their heights and, with "
            "`state=texture`, the textures of the particles' state as `.exr`",
        .programs = "ParaView, Blender (script below)",
        .place = 3};
    exporter.write = [](const ExportedMoment& moment, ExportFolder& folder) {
        const CollectedParticles* const own = moment.volume.particlesUnless(moment.dust);
        if (!own || !moment.dust.empty()) {
            const std::string name = fileOf(moment, "vtp");
            writeVtp(moment.dust, moment.origin(), folder.file(name));
            folder.addTo(own ? "dust.pvd" : "particles.pvd", Series::Kind::pvd, name, moment);
        }
        if (own) {
            const std::string name = ownFileOf(moment, "vtp");
            writeVtp(own->all, moment.origin(), folder.file(name), own->systems);
            for (const std::string& series : {std::string("particles.pvd"), fmt::format("{}.pvd", moment.method)})
                folder.addTo(series, Series::Kind::pvd, name, moment);
        }
        writeSurfaces(moment, folder);
        writeTextures(moment, folder);
    };
    return exporter;
}

}  // namespace vtp_format

}  // namespace dustbench::exports
