#include "methods/kit/meshes/mesh_file.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkPolygon.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/maths/srgb.h"
#include "methods/kit/meshes/polygons.h"

namespace dustbench::meshes {
namespace {

constexpr double creaseDegrees = 35;

Polygons readPolygons(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto read = extension == ".obj"   ? &readObj
                      : extension == ".ply" ? &readPly
                      : extension == ".stl" ? &readStl
                                            : nullptr;
    if (read == nullptr)
        throw InputError(file.string() + ": unknown mesh format '" + extension + "', expected .obj, .ply or .stl");
    const std::string text = files::wholeText(file, "a mesh", files::limits::geometryBytes);
    files::noteInput(file);
    Polygons mesh = read(text, file);
    files::noteIgnored(file, mesh.ignored);
    return mesh;
}

/// Cuts polygons into n − 2 triangles each: concave ones by ear clipping, ones without area into a fan.
class Triangulator {
 public:
    explicit Triangulator(const Polygons& mesh) : mesh_(mesh) {}

    /// Calls `take` with three positions for each triangle.
    template <typename Take>
    void cut(std::span<const std::uint32_t> corners, const Take& take) {
        const auto triangles = static_cast<vtkIdType>(corners.size()) - 2;
        if (triangles > 1) {
            load(corners);
            if (polygon_->Triangulate(ears_) != 0 && ears_->GetNumberOfIds() == 3 * triangles) {
                const auto corner = [&](vtkIdType i) { return corners[static_cast<std::size_t>(ears_->GetId(i))]; };
                for (vtkIdType i = 0; i < 3 * triangles; i += 3) take(corner(i), corner(i + 1), corner(i + 2));
                return;
            }
        }
        for (std::size_t i = 2; i < corners.size(); ++i) take(corners[0], corners[i - 1], corners[i]);
    }

 private:
    void load(std::span<const std::uint32_t> corners) {
        const auto count = static_cast<vtkIdType>(corners.size());
        polygon_->PointIds->SetNumberOfIds(count);
        polygon_->Points->SetNumberOfPoints(count);
        for (vtkIdType i = 0; i < count; ++i) {
            const glm::dvec3 p(mesh_.positions[corners[static_cast<std::size_t>(i)]]);
            polygon_->PointIds->SetId(i, corners[static_cast<std::size_t>(i)]);
            polygon_->Points->SetPoint(i, p.x, p.y, p.z);
        }
    }

    const Polygons& mesh_;
    vtkNew<vtkPolygon> polygon_;
    vtkNew<vtkIdList> ears_;
};

vtkSmartPointer<vtkUnsignedCharArray> colourArray() {
    auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
    colours->SetNumberOfComponents(3);
    return colours;
}

/// Each triangle gets the colour of its polygon.
void addTriangles(const Polygons& mesh, vtkPolyData& surface) {
    vtkNew<vtkCellArray> triangles;
    const auto colours = colourArray();
    Triangulator triangulator(mesh);
    for (std::size_t i = 0; i < mesh.size(); ++i)
        triangulator.cut(mesh[i], [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            triangles->InsertNextCell({a, b, c});
            if (!mesh.faceColours.empty()) colours->InsertNextTypedTuple(mesh.faceColours[i].data());
        });
    surface.SetPolys(triangles);
    if (!mesh.faceColours.empty()) surface.GetCellData()->SetScalars(colours);
}

vtkSmartPointer<vtkPolyData> surfaceOf(const Polygons& mesh) {
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToFloat();
    for (const glm::vec3& p : mesh.positions)
        points->InsertNextPoint(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
    surface->SetPoints(points);
    if (!mesh.normals.empty()) {
        vtkNew<vtkFloatArray> normals;
        normals->SetNumberOfComponents(3);
        for (const glm::vec3& n : mesh.normals) normals->InsertNextTypedTuple(&n.x);
        surface->GetPointData()->SetNormals(normals);
    }
    if (!mesh.colours.empty()) {
        const auto colours = colourArray();
        for (const Colour8& colour : mesh.colours) colours->InsertNextTypedTuple(colour.data());
        surface->GetPointData()->SetScalars(colours);
    }
    addTriangles(mesh, *surface);
    return surface;
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

constexpr const char* pointName = "point";

/// Numbers the points, so that the origin of each vertex is known later.
void numberPoints(vtkPolyData& surface) {
    vtkNew<vtkIdTypeArray> numbers;
    numbers->SetName(pointName);
    for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) numbers->InsertNextValue(i);
    surface.GetPointData()->AddArray(numbers);
}

/// `points` receives the number of each vertex, if the surface's points are numbered.
scene::Mesh convert(vtkPolyData& surface, const glm::vec3& colour, std::vector<std::size_t>* points = nullptr) {
    scene::Mesh mesh;
    auto* numbers = vtkIdTypeArray::SafeDownCast(surface.GetPointData()->GetArray(pointName));
    vtkDataArray* normals = surface.GetPointData()->GetNormals();
    vtkUnsignedCharArray* colours = coloursOf(*surface.GetPointData());
    vtkUnsignedCharArray* faceColours = colours ? nullptr : coloursOf(*surface.GetCellData());
    const auto addPoint = [&](vtkIdType i, const glm::vec3& own) {
        mesh.positions.push_back(tuple(*surface.GetPoints()->GetData(), i));
        const glm::vec3 normal = tuple(*normals, i);
        mesh.normals.push_back(glm::length(normal) > 0 ? glm::normalize(normal) : glm::vec3(0, 1, 0));
        mesh.colours.push_back(own);
        if (points && numbers) points->push_back(static_cast<std::size_t>(numbers->GetValue(i)));
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

/// With normals; computes them if the file has none.
vtkSmartPointer<vtkPolyData> withNormals(vtkSmartPointer<vtkPolyData> surface) {
    if (surface->GetPointData()->GetNormals()) return surface;
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(surface);
    normals->SetFeatureAngle(creaseDegrees);
    normals->ConsistencyOff();  // the winding defines the outside
    normals->Update();
    return normals->GetOutput();
}

/// Throws InputError unless both have the same polygons.
void requireSamePolygons(const Polygons& rest, const std::filesystem::path& restFile, const Polygons& target,
                         const std::filesystem::path& targetFile) {
    if (target.positions.size() != rest.positions.size() || target.size() != rest.size())
        throw InputError(fmt::format("{}: got {} points and {} faces, expected {} and {} as in {}, its base mesh",
                                     targetFile.string(), target.positions.size(), target.size(), rest.positions.size(),
                                     rest.size(), restFile.string()));
    for (std::size_t face = 0; face < rest.size(); ++face)
        if (!std::ranges::equal(rest[face], target[face]))
            throw InputError(fmt::format("{}: face {} has different corners than in {}, its base mesh",
                                         targetFile.string(), face + 1, restFile.string()));
}

/// Vertex normals: the mean of the surrounding triangles, weighted by area.
void computeNormals(scene::Mesh& mesh) {
    std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const glm::vec3 area = glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t corner : {a, b, c}) sums[corner] += area;
    }
    for (std::size_t v = 0; v < sums.size(); ++v)
        if (const float length = glm::length(sums[v]); length > 0) mesh.normals[v] = sums[v] / length;
}

}  // namespace

scene::Mesh readMesh(const std::filesystem::path& file, const glm::vec3& colour) {
    return convert(*withNormals(surfaceOf(readPolygons(file))), colour);
}

MorphMesh readMorphMesh(const std::filesystem::path& file, std::span<const std::filesystem::path> targets,
                        const glm::vec3& colour) {
    const Polygons rest = readPolygons(file);
    const vtkSmartPointer<vtkPolyData> surface = surfaceOf(rest);
    numberPoints(*surface);
    std::vector<std::size_t> points;
    MorphMesh morph{convert(*withNormals(surface), colour, &points), {}};
    for (const std::filesystem::path& targetFile : targets) {
        const Polygons target = readPolygons(targetFile);
        requireSamePolygons(rest, file, target, targetFile);
        std::vector<glm::vec3>& offsets = morph.offsets.emplace_back();
        for (const std::size_t point : points) offsets.push_back(target.positions[point] - rest.positions[point]);
    }
    return morph;
}

scene::DeformedMesh deformed(const MorphMesh& morph, std::span<const double> weights,
                             std::span<const double> weightsPerSecond) {
    if (weights.size() != morph.offsets.size() || weightsPerSecond.size() != morph.offsets.size())
        throw std::invalid_argument("deformed: expected a weight and its rate for each target");
    scene::DeformedMesh result{morph.rest, std::vector<glm::vec3>(morph.rest.positions.size(), glm::vec3(0))};
    for (std::size_t t = 0; t < weights.size(); ++t) {
        const auto weight = static_cast<float>(weights[t]), perSecond = static_cast<float>(weightsPerSecond[t]);
        for (std::size_t v = 0; v < result.velocities.size(); ++v) {
            result.mesh.positions[v] += weight * morph.offsets[t][v];
            result.velocities[v] += perSecond * morph.offsets[t][v];
        }
    }
    computeNormals(result.mesh);
    return result;
}

std::size_t openEdges(const scene::Mesh& mesh) {
    // Corners at the same position get the same number: their rank among all positions.
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::vector<glm::vec3> places(mesh.positions);
    std::sort(places.begin(), places.end(), less);
    std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> edges;
    edges.reserve(mesh.indices.size());
    const auto rank = [&](std::size_t corner) {
        return std::lower_bound(places.begin(), places.end(), mesh.positions[mesh.indices[corner]], less) -
               places.begin();
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::ptrdiff_t a = rank(i + k), b = rank(i + (k + 1) % 3);
            if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
        }
    std::sort(edges.begin(), edges.end());
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t same = i;
        while (same < edges.size() && edges[same] == edges[i]) ++same;
        open += (same - i) % 2;
        i = same;
    }
    return open;
}

}  // namespace dustbench::meshes
