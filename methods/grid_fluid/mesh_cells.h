// Finds the cells of a grid inside closed meshes, by rays along x through the centres of each row of cells.
//
// A ray counts the surfaces that it enters and leaves, from both ends; a cell is inside if both counts agree. So meshes
// may overlap, and open panels on a surface do no harm.
//
// A wall that passes between two centres fills the cell that contains its middle. Rays along x, y and z find the places
// where a mesh is entered and left between neighbouring centres, through surfaces that face away from each other. So no
// path from cell to cell through their faces leads through a wall, however thin. A smooth rim, whose surfaces face the
// same way there, does not fill a cell.
//
// If a mesh deforms, the same rays give its cells the velocity of its surface at the crossings, interpolated from its
// vertices. Along an axis, each cell next to the surface has the speed of the surface between it and its neighbour, or
// the mean of both sides if the mesh is only one cell thick. So the outflow through the cells' faces equals the volume
// displaced by the surface, summed over the rays.
//
// Units: cells; velocities m/s. Owns: a byte for each cell, booked, and a velocity once a mesh has velocities. Threads:
// one writer.
// Source: Crane2007, 30.2.4. Departs: rays by row instead of slices by the GPU's stencil. With a flow_gl::CellsOnRays
// the GPU traces them and finds the same cells.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/solid.h"
#include "methods/grid_fluid/flow_gl/cells_on_rays.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::grid_fluid {

class MeshCells {
 public:
    /// With a `gpu`, which must outlive this, the GPU finds the cells inside meshes.
    MeshCells(glm::ivec3 cells, MemoryAccount& account, flow_gl::CellsOnRays* gpu = nullptr);

    void clear();
    /// Sets cells whose centre is inside the mesh, and those of thin walls, to `body`, overwriting previous values.
    /// `toCells` transforms the mesh's positions to cell units from the minimum corner of the grid; `velocities` are
    /// those of the positions along the grid's axes, of a mesh that deforms.
    void add(const scene::Mesh& mesh, const glm::dmat4& toCells, std::uint8_t body,
             std::span<const glm::vec3> velocities = {});
    /// Ends a series of meshes: only then are the cells complete.
    void finish();
    /// Sets one cell, for shapes that are not meshes; before the first mesh.
    void set(int i, int j, int k, std::uint8_t body) { bodies_[index(i, j, k)] = body; }

    /// A number for each cell, x fastest; 0: no body.
    [[nodiscard]] std::span<const std::uint8_t> bodies() const { return bodies_; }
    /// Velocities of the cells of deforming meshes; undefined elsewhere, and empty before the first such mesh.
    [[nodiscard]] std::span<const glm::vec3> velocities() const { return velocities_; }
    [[nodiscard]] glm::ivec3 cells() const { return cells_; }

 private:
    /// Rays along one axis, with coordinates permuted so that this axis comes first.
    struct Sweep {
        glm::ivec3 cells;    ///< number of cells along the rays, and numbers of rays
        glm::ivec3 strides;  ///< in `bodies_`
    };
    /// Intersection of a row's ray with a surface.
    struct Crossing {
        std::uint32_t row;
        float x;
        int inwards;  ///< 1 entering, −1 leaving
        glm::vec3 normal;
        std::uint32_t number;  ///< in the order in which they were found
    };
    [[nodiscard]] std::size_t index(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(cells_.y) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(cells_.x) +
               static_cast<std::size_t>(i);
    }
    [[nodiscard]] Sweep sweepAlong(int axis) const;
    void findCrossings(const Sweep& sweep, std::span<const std::uint32_t> indices,
                       std::span<const glm::vec3> velocities);
    template <typename Take>
    void forEachRow(const Take& take) const;
    void sweep(std::span<const std::uint32_t> indices, int axis, std::uint8_t body);
    template <typename Take>
    void cross(const Sweep& sweep, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const Take& take);
    void fillRow(std::span<const Crossing> crossings, std::uint8_t body);
    void fillThinWalls(const Sweep& sweep, std::span<const Crossing> crossings, std::uint8_t body);
    void setVelocities(const Sweep& sweep, int axis, std::span<const Crossing> crossings, std::uint8_t body);
    [[nodiscard]] glm::vec3 velocityAt(float x, std::span<const Crossing> crossings) const;

    glm::ivec3 cells_;
    flow_gl::CellsOnRays* gpu_;
    bool areOnGpu_ = false;  ///< the cells on the GPU are newer than `bodies_`
    LedgerVector<std::uint8_t> bodies_;
    LedgerVector<glm::vec3> velocities_;
    std::vector<glm::dvec3> places_;
    std::vector<Crossing> crossings_;
    std::vector<glm::vec3> crossingVelocities_;  ///< by Crossing::number
    std::vector<std::uint8_t> known_;  ///< of each cell: bit `axis` if the rays along that axis gave its speed
    std::vector<int> depths_;
};

}  // namespace dustbench::grid_fluid
