// The mesh named in a part: `mesh = "hare"`, or a file's path.
//
// Units: m. Frame: the mesh's own, scaled.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/parameters.h"

namespace dustbench::particles {

/// Declares `mesh`, `scale` and `open`.
void declareMesh(ParameterSet& set);

/// The triangles that have an area. Throws InputError if the file is missing or unreadable, if no triangle has an area,
/// or if the surface has a hole and `open` is off.
[[nodiscard]] std::vector<std::array<glm::vec3, 3>> trianglesOf(const ParameterValues& values);

[[nodiscard]] inline double areaOf(const std::array<glm::vec3, 3>& triangle) {
    const glm::dvec3 a(triangle[0]), b(triangle[1]), c(triangle[2]);
    return glm::length(glm::cross(b - a, c - a)) / 2;
}

}  // namespace dustbench::particles
