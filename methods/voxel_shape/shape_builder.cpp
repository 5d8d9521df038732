#include "methods/voxel_shape/shape_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "methods/contract/errors.h"
#include "methods/kit/meshes/mesh_file.h"
#include "methods/voxel_shape/voxels/slice_pass.h"
#include "methods/voxel_shape/voxels/solid_fill.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/voxel_file.h"

namespace dustbench::voxel_shape {
namespace {

/// Returns body and wheels at rest, in the vehicle's frame.
scene::Mesh vehicleMesh(const scene::VehicleModel& vehicle) {
    scene::Mesh mesh;
    mesh.append(*vehicle.body.mesh, glm::mat4(1));
    const scene::VehicleParameters& p = vehicle.parameters;
    for (const double x : {0.0, p.wheelbaseMetres})
        for (const double side : {-1.0, 1.0}) {
            glm::dmat4 place = glm::translate(glm::dmat4(1), {x, p.wheelRadiusMetres, side * p.trackMetres / 2});
            // A wheel's outer face points to +Z; left wheels are rotated by half a turn.
            if (side < 0) place = glm::rotate(place, glm::pi<double>(), {0, 1, 0});
            mesh.append(*vehicle.wheel.mesh, glm::mat4(place));
        }
    return mesh;
}

/// Rotates and scales the mesh, and places it on y = 0, centred in x and z.
void stand(scene::Mesh& mesh, const glm::vec3& turn, float longestSideMetres) {
    glm::mat4 rotation = glm::rotate(glm::mat4(1), turn.y, {0, 1, 0});
    rotation = glm::rotate(rotation, turn.z, {0, 0, 1});
    rotation = glm::rotate(rotation, turn.x, {1, 0, 0});
    glm::vec3 minimum(INFINITY), maximum(-INFINITY);
    for (glm::vec3& normal : mesh.normals) normal = glm::mat3(rotation) * normal;
    for (glm::vec3& position : mesh.positions) {
        position = glm::mat3(rotation) * position;
        minimum = glm::min(minimum, position);
        maximum = glm::max(maximum, position);
    }
    const glm::vec3 extent = maximum - minimum;
    const float longest = std::max({extent.x, extent.y, extent.z});
    const float scale = longestSideMetres > 0 && longest > 0 ? longestSideMetres / longest : 1.0f;
    const glm::vec3 foot((minimum.x + maximum.x) / 2, minimum.y, (minimum.z + maximum.z) / 2);
    for (glm::vec3& position : mesh.positions) position = scale * (position - foot);
}

/// Darkens surfaces by how far they face down. The scene does not light the puffs; this shading is valid for any
/// rotation about y.
void lightFromAbove(scene::Mesh& mesh, float share) {
    for (std::size_t i = 0; i < mesh.colours.size(); ++i) mesh.colours[i] *= 1 - share * (1 - mesh.normals[i].y) / 2;
}

MarkedVoxels wholeGrid(const Shape& shape) {
    const glm::vec3 extent = shape.gridEdgeMetres * glm::vec3(shape.gridCells);
    MarkedVoxels marked(Lattice{shape.gridCells, {-extent.x / 2, 0, -extent.z / 2}, shape.gridEdgeMetres});
    std::ranges::fill(marked.marked, std::uint8_t{1});
    std::ranges::fill(marked.colours, shape.meshColour);
    return marked;
}

MarkedVoxels voxelise(const Shape& shape, const scene::Scene& scene, gpu::Device& device) {
    if (shape.source == Source::grid) return wholeGrid(shape);
    const scene::Mesh mesh = meshOf(shape, scene);
    const Lattice lattice = latticeAround(mesh, shape.resolution);
    if (shape.voxeliser == Voxeliser::slices) return slicePass(device, mesh, lattice);
    if (shape.voxeliser == Voxeliser::slicesXyz) return slicesAlongAllAxes(device, mesh, lattice);
    MarkedVoxels marked = surfaceVoxels(mesh, lattice);
    if (shape.fill == Fill::solid) fillSolid(marked, mesh);
    return marked;
}

/// Sets the attributes of all voxels, then applies the edits that add or remove voxels, then distributes the particles.
void setVoxels(VoxelGrid& grid, const Shape& shape) {
    for (const std::uint32_t i : grid.active()) {
        Voxel& voxel = grid.voxels()[i];
        voxel.fadingColour = voxel.colour;  // default
        shape.voxels.applyTo(voxel, grid.lattice().edgeMetres);
    }
    for (const VoxelEdit& edit : shape.edits)
        if (edit.change.active) edit.applyTo(grid);
    grid.shareOut(shape.particles);
    for (const std::uint32_t i : grid.active())
        if (shape.voxels.maximumDensity) grid.voxels()[i].maximumDensity = *shape.voxels.maximumDensity;
}

/// Gives the voxels of single rows a force around the row's axis, unless they have one.
void setRowForces(VoxelGrid& grid, const RowForce& force) {
    const std::vector<glm::vec3> rows = rowsOf(grid);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        Voxel& voxel = grid.voxels()[grid.active()[k]];
        if (rows[k] != glm::vec3(0) && voxel.force == glm::vec3(0))
            voxel.setForce(Force::helix, force.radiansPerSecond * rows[k], force.metresPerRadian);
    }
}

}  // namespace

scene::Mesh meshOf(const Shape& shape, const scene::Scene& scene) {
    if (shape.source == Source::vehicle) {
        if (!scene.vehicle)
            throw InputError("shape '" + shape.name + "': uses the vehicle's mesh, but scene '" + scene.id +
                             "' has none");
        scene::Mesh mesh = vehicleMesh(*scene.vehicle);
        lightFromAbove(mesh, shape.lightFromAbove);
        return mesh;
    }
    scene::Mesh mesh = meshes::readMesh(shape.mesh, shape.meshColour);
    stand(mesh, shape.turn, shape.longestSideMetres);
    lightFromAbove(mesh, shape.lightFromAbove);
    return mesh;
}

ShapeSystem buildShape(MemoryLedger& ledger, const Shape& shape, const scene::Scene& scene, gpu::Device& device,
                       std::uint64_t seed) {
    if (shape.track.followsVehicle && !scene.vehicle)
        throw InputError("shape '" + shape.name + "': follows the vehicle, but scene '" + scene.id + "' has none");
    ShapeSystem system = shape.source == Source::voxels
                             ? ShapeSystem(ledger, readVoxels(ledger, shape.mesh), seed)
                             : ShapeSystem(ledger, voxelise(shape, scene, device), Voxel(), seed);
    VoxelGrid& grid = system.grid();
    if (shape.source != Source::voxels) setVoxels(grid, shape);
    for (const VoxelEdit& edit : shape.edits)
        if (shape.source == Source::voxels || edit.change.active.value_or(true)) edit.applyTo(grid);
    if (grid.active().empty())
        throw InputError("shape '" + shape.name + "': got no active voxel, expected at least one to hold particles");
    if (shape.rowForce) setRowForces(grid, *shape.rowForce);
    if (shape.load.isOn()) showStress(shape.load, grid);
    if (!shape.savedVoxels.empty()) writeVoxels(grid, shape.savedVoxels);
    return system;
}

}  // namespace dustbench::voxel_shape
