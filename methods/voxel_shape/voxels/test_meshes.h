// Meshes of known shape, for tests and benchmarks.
//
// Units: metres. Colours: linear RGB.
#pragma once

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "methods/contract/solid.h"

namespace dustbench::voxel_shape {

/// Returns a sphere around the origin: `rows` rings of 2·rows quads. Its colour changes from red to blue along x.
[[nodiscard]] inline scene::Mesh sphereMesh(float radius, int rows) {
    scene::Mesh mesh;
    const int columns = 2 * rows;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const float polar = glm::pi<float>() * static_cast<float>(j) / static_cast<float>(rows);
            const float around = glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(columns);
            // The poles are exact, so that the corners there coincide.
            const float ring = j == 0 || j == rows ? 0.0f : std::sin(polar);
            mesh.positions.push_back(radius *
                                     glm::vec3(ring * std::cos(around), std::cos(polar), ring * std::sin(around)));
            const float share = 0.5f + 0.5f * ring * std::cos(around);
            mesh.colours.emplace_back(1 - share, 0, share);
        }
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto at = [&](int row, int column) {
                return static_cast<std::uint32_t>(row * columns + column % columns);
            };
            for (const std::uint32_t index : {at(j, i), at(j, i + 1), at(j + 1, i)}) mesh.indices.push_back(index);
            for (const std::uint32_t index : {at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)})
                mesh.indices.push_back(index);
        }
    return mesh;
}

/// Returns a flat rectangle with one corner at `corner` and two sides.
[[nodiscard]] inline scene::Mesh rectangleMesh(const glm::vec3& corner, const glm::vec3& side, const glm::vec3& other) {
    scene::Mesh mesh;
    mesh.positions = {corner, corner + side, corner + side + other, corner + other};
    mesh.colours.assign(4, glm::vec3(0.5f));
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

}  // namespace dustbench::voxel_shape
