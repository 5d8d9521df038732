#include "bench/export/vtp_writer.h"

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

#include "bench/export/exporter.h"
#include "bench/export/surface_writer.h"
#include "bench/export/vtk_file.h"
#include "bench/export/whole_file.h"
#include "methods/contract/volume.h"

namespace dustbench::bench {
namespace {

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

}  // namespace dustbench::bench
