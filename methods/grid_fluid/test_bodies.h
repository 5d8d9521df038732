// Solids for the tests in this folder.
#pragma once

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "methods/contract/solid.h"

namespace dustbench::grid_fluid {

/// Returns a ball of radius 1 with `rings` rings; its poles lie on the y axis.
inline scene::Mesh ball(int rings) {
    scene::Mesh mesh;
    const int sides = 2 * rings;
    for (int r = 0; r <= rings; ++r)
        for (int s = 0; s < sides; ++s) {
            const double polar = std::numbers::pi * r / rings, turn = 2 * std::numbers::pi * s / sides;
            mesh.positions.emplace_back(std::sin(polar) * std::cos(turn), std::cos(polar),
                                        -std::sin(polar) * std::sin(turn));
        }
    const auto corner = [&](int r, int s) { return static_cast<std::uint32_t>(r * sides + s % sides); };
    for (int r = 0; r < rings; ++r)
        for (int s = 0; s < sides; ++s)
            for (const std::uint32_t index : {corner(r, s), corner(r + 1, s), corner(r + 1, s + 1), corner(r, s),
                                              corner(r + 1, s + 1), corner(r, s + 1)})
                mesh.indices.push_back(index);
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    mesh.colours.assign(mesh.positions.size(), glm::vec3(0.5f));
    return mesh;
}

inline glm::dmat4 placed(const glm::dvec3& middle, double scale) {
    return glm::scale(glm::translate(glm::dmat4(1), middle), glm::dvec3(scale));
}

/// A box centred at 0 with edges of these lengths.
inline scene::Mesh block(const glm::vec3& edges) {
    scene::Mesh mesh;
    for (int n = 0; n < 8; ++n) mesh.positions.push_back(edges * (glm::vec3(n & 1, n >> 1 & 1, n >> 2) - 0.5f));
    for (const std::array<std::uint32_t, 4>& side : std::array<std::array<std::uint32_t, 4>, 6>{
             {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}})
        for (const int n : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(side[static_cast<std::size_t>(n)]);
    mesh.normals.assign(8, glm::vec3(0, 1, 0));
    mesh.colours.assign(8, glm::vec3(0.5f));
    return mesh;
}

}  // namespace dustbench::grid_fluid
