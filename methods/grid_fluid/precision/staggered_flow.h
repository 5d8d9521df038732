// A flow with speeds on faces, its file format, so that flows of any solver can be compared, and its distance from a
// reference on the same cells.
//
// File: the line `dustbench-flow 1 NX NY NZ`, then 32-bit floats, little-endian, x fastest: the density of NX·NY·NZ
// cells, then the speeds along x of (NX+1)·NY·NZ faces, along y of NX·(NY+1)·NZ and along z of NX·NY·(NZ+1).
// Units: SI. Threads: pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/fluid_solver.h"

namespace dustbench::grid_fluid::precision {

struct StaggeredFlow {
    StaggeredFlow() = default;
    /// At rest, without smoke.
    explicit StaggeredFlow(glm::ivec3 cells);

    [[nodiscard]] glm::ivec3 faces(int axis) const {
        glm::ivec3 count = cells;
        if (axis >= 0) ++count[axis];
        return count;
    }
    [[nodiscard]] std::size_t cell(int i, int j, int k) const { return index(cells, i, j, k); }
    /// The face of a cell towards −axis; for the index after the last cell, the last cell's face towards +axis.
    [[nodiscard]] std::size_t face(int axis, int i, int j, int k) const { return index(faces(axis), i, j, k); }

    glm::ivec3 cells{0};
    std::vector<float> density;
    std::array<std::vector<float>, 3> speeds;

 private:
    static std::size_t index(const glm::ivec3& count, int i, int j, int k) {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(count.y) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(count.x) +
               static_cast<std::size_t>(i);
    }
};

/// Copies the flow that a solver stores.
[[nodiscard]] StaggeredFlow storedBy(const flow::FluidSolver& solver);
/// Replaces a solver's speeds and density; its solids must be set already.
void giveTo(flow::FluidSolver& solver, const StaggeredFlow& flow);

/// Throws InputError with the file.
void writeFlow(const std::filesystem::path& file, const StaggeredFlow& flow);
/// Throws InputError with the file if it is not a flow, is larger than 1 GB, does not have the length given by its
/// first line, or contains a value that is not finite. Checks the length before it allocates memory.
[[nodiscard]] StaggeredFlow readFlow(const std::filesystem::path& file);
/// Writes 32-bit floats without a first line.
void writeFloats(const std::filesystem::path& file, std::span<const float> values);

// --- Comparison

/// Means over `refinement`³ cells and `refinement`² faces, which preserve the flow through the coarse faces. A flow on
/// a finer grid is averaged before it is compared.
[[nodiscard]] StaggeredFlow averaged(const StaggeredFlow& flow, int refinement);

struct FlowDistance {
    double density = 0;    ///< ‖a − b‖ / ‖b‖ over cells
    double velocity = 0;   ///< the same for speeds over faces
    double enstrophy = 0;  ///< |ln(Σω²(a) / Σω²(b))|, ω of the edges between the cells
    /// Root mean square of ln(E(a) / E(b)) over the wave numbers 1, 2, … of the velocity's cosine series, in half waves
    /// per width along z, up to the finest that the cells hold.
    double spectrum = 0;
};
[[nodiscard]] FlowDistance distanceOf(const StaggeredFlow& flow, const StaggeredFlow& reference);

/// Conserved or bounded quantities.
struct FlowSums {
    double massM3 = 0;             ///< Σ density·volume
    double energyM5PerS2 = 0;      ///< Σ u²/2·volume over faces
    double divergencePerStep = 0;  ///< maximum of |∇·u|·Δt over cells that are not solid
};
[[nodiscard]] FlowSums sumsOf(const StaggeredFlow& flow, std::span<const std::uint8_t> solids, double spacingMetres,
                              double stepSeconds);

}  // namespace dustbench::grid_fluid::precision
