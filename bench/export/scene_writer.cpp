#include "bench/export/scene_writer.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLMultiBlockDataWriter.h>

#include <cmath>
#include <stdexcept>

#include "bench/export/vtk_file.h"
#include "bench/export/whole_file.h"
#include "bench/measure/sha256.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::exports {
namespace fs = std::filesystem;
namespace {

constexpr double groundMarginMetres = 20;
constexpr std::int64_t maximumGroundPoints = 1 << 18;
constexpr const char* scenePieces = "scene";

/// Collects points, normals and triangles one by one.
class Surface {
 public:
    Surface() { normals_->SetNumberOfComponents(3); }

    void addPoint(const glm::dvec3& position, const glm::vec3& normal) {
        points_->InsertNextPoint(position.x, position.y, position.z);
        normals_->InsertNextTuple3(static_cast<double>(normal.x), static_cast<double>(normal.y),
                                   static_cast<double>(normal.z));
    }
    void addTriangle(std::int64_t a, std::int64_t b, std::int64_t c) { triangles_->InsertNextCell({a, b, c}); }

    [[nodiscard]] vtkNew<vtkPolyData> finish() {
        vtkNew<vtkPolyData> surface;
        normals_->SetName("Normals");
        surface->SetPoints(points_);
        surface->SetPolys(triangles_);
        surface->GetPointData()->SetNormals(normals_);
        return surface;
    }

 private:
    vtkNew<vtkPoints> points_;
    vtkNew<vtkFloatArray> normals_;
    vtkNew<vtkCellArray> triangles_;
};

/// A flat ground is one rectangle; a height field uses its own samples, of which every second, fourth … is kept if
/// there are too many.
vtkNew<vtkPolyData> groundSurface(const scene::Terrain& terrain, const Box& part) {
    glm::dvec2 origin(part.minimum.x, part.minimum.z);
    glm::dvec2 step(part.extent().x, part.extent().z);
    std::int64_t first[2] = {0, 0}, last[2] = {1, 1};
    if (!terrain.isFlat()) {
        origin = terrain.origin();
        for (double spacing = static_cast<double>(terrain.spacingMetres());; spacing *= 2) {
            step = glm::dvec2(spacing);
            for (int axis = 0; axis < 2; ++axis) {
                const int side = 2 * axis;  // x, z
                first[axis] = std::llround(std::floor((part.minimum[side] - origin[axis]) / spacing));
                last[axis] = std::llround(std::ceil((part.maximum[side] - origin[axis]) / spacing));
            }
            if ((last[0] - first[0] + 1) * (last[1] - first[1] + 1) <= maximumGroundPoints) break;
        }
    }
    Surface surface;
    for (std::int64_t j = first[1]; j <= last[1]; ++j)
        for (std::int64_t i = first[0]; i <= last[0]; ++i) {
            const double x = origin.x + static_cast<double>(i) * step.x;
            const double z = origin.y + static_cast<double>(j) * step.y;
            const auto nearX = static_cast<float>(x), nearZ = static_cast<float>(z);
            surface.addPoint({x, static_cast<double>(terrain.heightAt(nearX, nearZ)), z},
                             terrain.normalAt(nearX, nearZ));
        }
    // Triangulated as the ground in the picture (draw/ground_lattice).
    const std::int64_t across = last[0] - first[0] + 1;
    for (std::int64_t j = 0; j < last[1] - first[1]; ++j)
        for (std::int64_t i = 0; i + 1 < across; ++i) {
            const std::int64_t a = j * across + i, b = a + 1, c = a + across, d = c + 1;
            surface.addTriangle(a, c, d);
            surface.addTriangle(a, d, b);
        }
    return surface.finish();
}

vtkNew<vtkPolyData> placed(const scene::Mesh& mesh, const glm::mat4& toWorld) {
    Surface surface;
    const glm::mat3 turn(toWorld);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        surface.addPoint(glm::dvec3(glm::dmat4(toWorld) * glm::dvec4(mesh.positions[i], 1)),
                         glm::normalize(turn * mesh.normals[i]));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        surface.addTriangle(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
    vtkNew<vtkPolyData> placed = surface.finish();
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetName("colour");
    colours->SetNumberOfComponents(3);
    for (const glm::vec3& colour : mesh.colours)
        for (int channel = 0; channel < 3; ++channel) {
            const float encoded = maths::encodeSrgb(glm::clamp(colour[channel], 0.0f, 1.0f));
            colours->InsertNextValue(static_cast<unsigned char>(std::lround(encoded * 255)));
        }
    placed->GetPointData()->SetScalars(colours);
    return placed;
}

void addBlock(vtkMultiBlockDataSet& blocks, const std::string& name, vtkPolyData* surface) {
    const unsigned index = blocks.GetNumberOfBlocks();
    blocks.SetBlock(index, surface);
    blocks.GetMetaData(index)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

/// Moves the pieces that VTK wrote below `written` to the folder of pieces next to `file`. Pieces are named after their
/// content, so that all frames share those that do not change. Returns the text of the file.
std::string keepPieces(const fs::path& written, const fs::path& file) {
    const fs::path folder = file.parent_path() / scenePieces;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) files::failWriting(folder, error.value());
    std::string text = files::wholeText(written / file.filename(), "a .vtm", files::limits::geometryBytes);
    const std::string stem = file.stem();
    for (const auto& entry : fs::directory_iterator(written / stem)) {
        const std::string name = measure::sha256OfFile(entry.path()).substr(0, 16) + ".vtp";
        if (!fs::exists(folder / name)) fs::rename(entry.path(), folder / name, error);
        if (error) files::failWriting(folder / name, error.value());
        const std::string before = fmt::format("\"{}/{}\"", stem, entry.path().filename().string());
        const std::size_t at = text.find(before);
        if (at == std::string::npos) throw std::runtime_error("VTK's .vtm does not name its piece " + before);
        text.replace(at, before.size(), fmt::format("\"{}/{}\"", scenePieces, name));
    }
    return text;
}

}  // namespace

Box groundAround(const std::optional<Box>& cloud, const scene::Scene& scene, const scene::SceneState& state) {
    Box box{state.vehicle.position, state.vehicle.position};
    if (cloud) box.include(*cloud);
    for (std::size_t i = 0; scene.terrain.isFlat() && i < scene.solids.size(); ++i)
        for (const glm::vec3& position : scene::solidMesh(scene, state, i).positions) {
            const glm::dvec3 place(scene::solidPose(scene, state, i).toWorld * glm::vec4(position, 1));
            box.include({place, place});
        }
    return {box.minimum - groundMarginMetres, box.maximum + groundMarginMetres};
}

void writeScene(const scene::Scene& scene, const scene::SceneState& state, const Box& ground, double timeSeconds,
                const fs::path& file) {
    vtkNew<vtkMultiBlockDataSet> blocks;
    addBlock(*blocks, "terrain", groundSurface(scene.terrain, ground));
    if (scene.vehicle) {
        const scene::VehiclePoses poses = vehiclePoses(*scene.vehicle, state.vehicle);
        addBlock(*blocks, "body", placed(*scene.vehicle->body.mesh, poses.body.toWorld));
        const char* const names[] = {"wheel_front_left", "wheel_front_right", "wheel_rear_left", "wheel_rear_right"};
        for (std::size_t i = 0; i < poses.wheels.size(); ++i)
            addBlock(*blocks, names[i], placed(*scene.vehicle->wheel.mesh, poses.wheels[i].toWorld));
    }
    for (std::size_t i = 0; i < scene.solids.size(); ++i)
        addBlock(*blocks, scene.solids[i].name,
                 placed(scene::solidMesh(scene, state, i), scene::solidPose(scene, state, i).toWorld));
    stampTime(*blocks, timeSeconds);

    // VTK writes the pieces to a folder next to the file, with the file's name.
    WholeFile elsewhere(file);
    std::error_code error;
    fs::remove_all(elsewhere.temporaryPath(), error);
    fs::create_directory(elsewhere.temporaryPath(), error);
    if (error) files::failWriting(file, error.value());
    vtkNew<vtkXMLMultiBlockDataWriter> writer;
    writeVtk(*writer, *blocks, elsewhere.temporaryPath() / file.filename());
    const std::string names = keepPieces(elsewhere.temporaryPath(), file);
    fs::remove_all(elsewhere.temporaryPath(), error);
    writeWhole(file, names);
}

}  // namespace dustbench::exports
