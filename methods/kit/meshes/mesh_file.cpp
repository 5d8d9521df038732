#include "methods/kit/meshes/mesh_file.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkSmartPointer.h>
#include <vtkSTLReader.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/maths/srgb.h"
#include "methods/kit/meshes/mesh_check.h"

namespace dustbench::meshes {
namespace {

constexpr double creaseDegrees = 35;

/// Captures VTK's errors and warnings, which would otherwise go to standard error, and keeps the first.
class Complaints {
 public:
    Complaints() {
        command_->SetClientData(this);
        command_->SetCallback([](vtkObject*, unsigned long, void* client, void* data) {
            auto& self = *static_cast<Complaints*>(client);
            if (self.first_.empty() && data) self.first_ = static_cast<const char*>(data);
        });
    }
    void listenTo(vtkObject& object) {
        object.AddObserver("ErrorEvent", command_);
        object.AddObserver("WarningEvent", command_);
    }
    [[nodiscard]] bool any() const { return !first_.empty(); }
    /// The first message as one line, without VTK's source position.
    [[nodiscard]] std::string line() const {
        std::string text = first_;
        if (const auto colon = text.find("): "); colon != std::string::npos) text.erase(0, colon + 3);
        std::ranges::replace(text, '\n', ' ');
        while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
        return text;
    }

 private:
    vtkNew<vtkCallbackCommand> command_;
    std::string first_;
};

template <typename Reader>
vtkSmartPointer<vtkPolyDataAlgorithm> makeReader(const std::filesystem::path& file) {
    vtkNew<Reader> reader;
    reader->SetFileName(file.c_str());
    return vtkSmartPointer<vtkPolyDataAlgorithm>(reader);
}

vtkSmartPointer<vtkPolyDataAlgorithm> readerFor(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension == ".obj") return makeReader<vtkOBJReader>(file);
    if (extension == ".ply") return makeReader<vtkPLYReader>(file);
    if (extension == ".stl") return makeReader<vtkSTLReader>(file);
    throw InputError(file.string() + ": unknown kind of mesh '" + extension + "', expected .obj, .ply or .stl");
}

glm::vec3 tuple(vtkDataArray& array, vtkIdType index) {
    double values[3];
    array.GetTuple(index, values);
    return {values[0], values[1], values[2]};
}

/// Colours of points or of faces, if present: 8 bit, sRGB.
vtkUnsignedCharArray* coloursOf(vtkDataSetAttributes& attributes) {
    auto* colours = vtkUnsignedCharArray::SafeDownCast(attributes.GetScalars());
    return colours && colours->GetNumberOfComponents() >= 3 ? colours : nullptr;
}

glm::vec3 linearColour(vtkUnsignedCharArray& colours, vtkIdType index) {
    glm::vec3 colour;
    for (int k = 0; k < 3; ++k)
        colour[k] = maths::decodeSrgb(static_cast<float>(colours.GetTypedComponent(index, k)) / 255.0f);
    return colour;
}

scene::Mesh convert(vtkPolyData& surface, const glm::vec3& colour) {
    scene::Mesh mesh;
    vtkDataArray* normals = surface.GetPointData()->GetNormals();
    vtkUnsignedCharArray* colours = coloursOf(*surface.GetPointData());
    vtkUnsignedCharArray* faceColours = colours ? nullptr : coloursOf(*surface.GetCellData());
    const auto addPoint = [&](vtkIdType i, const glm::vec3& own) {
        mesh.positions.push_back(tuple(*surface.GetPoints()->GetData(), i));
        const glm::vec3 normal = tuple(*normals, i);
        mesh.normals.push_back(glm::length(normal) > 0 ? glm::normalize(normal) : glm::vec3(0, 1, 0));
        mesh.colours.push_back(own);
    };
    if (!faceColours)
        for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i)
            addPoint(i, colours ? linearColour(*colours, i) : colour);
    vtkCellArray* triangles = surface.GetPolys();
    for (vtkIdType i = 0; i < triangles->GetNumberOfCells(); ++i) {
        vtkIdType count = 0;
        const vtkIdType* corners = nullptr;
        triangles->GetCellAtId(i, count, corners);
        for (vtkIdType k = 0; k < count; ++k) {
            // Corners are not shared if faces have their own colours.
            mesh.indices.push_back(
                static_cast<std::uint32_t>(faceColours ? mesh.positions.size() : static_cast<std::size_t>(corners[k])));
            if (faceColours) addPoint(corners[k], linearColour(*faceColours, i));
        }
    }
    return mesh;
}

/// VTK's filters do not check the indices that its readers return.
void checkGeometry(vtkPolyData& surface, const std::filesystem::path& file) {
    const vtkIdType points = surface.GetNumberOfPoints();
    for (vtkIdType i = 0; i < points; ++i)
        for (int k = 0; k < 3; ++k)
            if (!std::isfinite(surface.GetPoint(i)[k]))
                throw InputError(file.string() + ": vertex " + std::to_string(i + 1) + " is not a finite point");
    for (vtkCellArray* cells : {surface.GetVerts(), surface.GetLines(), surface.GetPolys(), surface.GetStrips()})
        for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i) {
            vtkIdType count = 0;
            const vtkIdType* corners = nullptr;
            cells->GetCellAtId(i, count, corners);
            for (vtkIdType k = 0; k < count; ++k)
                if (corners[k] < 0 || corners[k] >= points)
                    throw InputError(file.string() + ": face " + std::to_string(i + 1) + " uses vertex " +
                                     std::to_string(corners[k] + 1) + ", the mesh has " + std::to_string(points));
        }
}

}  // namespace

scene::Mesh readMesh(const std::filesystem::path& file, const glm::vec3& colour) {
    const auto reader = readerFor(file);
    if (!std::ifstream(file) || std::filesystem::is_directory(file))
        throw InputError(file.string() + ": the mesh cannot be read");
    if (vtkOBJReader::SafeDownCast(reader)) checkObj(file);
    if (vtkPLYReader::SafeDownCast(reader)) checkPly(file);
    files::noteInput(file);
    Complaints complaints;
    complaints.listenTo(*reader);
    complaints.listenTo(*reader->GetExecutive());
    reader->Update();
    if (complaints.any()) throw InputError(file.string() + ": not a mesh that can be read: " + complaints.line());

    checkGeometry(*reader->GetOutput(), file);

    vtkNew<vtkTriangleFilter> triangles;
    triangles->SetInputConnection(reader->GetOutputPort());
    triangles->PassVertsOff();
    triangles->PassLinesOff();
    triangles->Update();
    vtkSmartPointer<vtkPolyData> surface = triangles->GetOutput();
    if (surface->GetNumberOfPolys() == 0)
        throw InputError(file.string() + ": the mesh has no triangles, or is not of the kind that its name says");
    if (!surface->GetPointData()->GetNormals()) {
        vtkNew<vtkPolyDataNormals> normals;
        normals->SetInputData(surface);
        normals->SetFeatureAngle(creaseDegrees);
        normals->ConsistencyOff();  // the winding defines the outside
        normals->Update();
        surface = normals->GetOutput();
    }
    return convert(*surface, colour);
}

}  // namespace dustbench::meshes
