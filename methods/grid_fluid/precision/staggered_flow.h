// A flow with speeds on faces, and its file format, so that flows of any solver can be compared.
//
// File: the line `dustbench-flow 1 NX NY NZ`, then 32-bit floats, little-endian, x fastest: the density of NX·NY·NZ
// cells, then the speeds along x of (NX+1)·NY·NZ faces, along y of NX·(NY+1)·NZ and along z of NX·NY·(NZ+1).
// Units: m/s.
#pragma once

#include <array>
#include <cstddef>
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

}  // namespace dustbench::grid_fluid::precision
