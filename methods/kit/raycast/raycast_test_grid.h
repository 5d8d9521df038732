// Grids for the ray caster's tests and benchmarks.
//
// Owns: the cell values.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

struct TestGrid {
    /// `densityAt` takes the centre of a cell, in metres.
    TestGrid(glm::ivec3 size, double spacing, glm::dvec3 origin, const std::function<double(glm::dvec3)>& densityAt)
        : cells(size), spacingMetres(spacing), originMetres(origin) {
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    density.push_back(static_cast<float>(densityAt(origin + spacing * (glm::dvec3(x, y, z) + 0.5))));
    }
    [[nodiscard]] ShownGrid shown() const { return {cells, spacingMetres, originMetres, density, reaction}; }

    glm::ivec3 cells;
    double spacingMetres;
    glm::dvec3 originMetres;
    std::vector<float> density, reaction;
};

/// A plume of smoke that extends along x and spreads: lumps of several sizes in clear air; 1 is thick. The outermost
/// cells are clear, so that results do not depend on how a renderer extends the grid.
inline TestGrid testPlume(glm::ivec3 size = {128, 64, 64}) {
    const double spacing = 6.4 / size.x;
    return {size, spacing, {-3.2, -1.6, -1.6}, [spacing](const glm::dvec3& at) {
                if (glm::any(glm::greaterThan(glm::abs(at), glm::dvec3(3.2, 1.6, 1.6) - 1.2 * spacing))) return 0.0;
                const double along = (at.x + 3.2) / 6.4;
                const double swing = 0.25 * along * std::sin(5 * along + 1);
                const double across = std::hypot(at.y - swing, at.z + 0.2 * along * std::cos(7 * along));
                double lumps = 0;
                for (int octave = 1, f = 3; octave <= 3; ++octave, f *= 2)
                    lumps +=
                        std::sin(f * at.x + 2 * octave) * std::sin(f * at.y + octave) * std::sin(f * at.z) / octave;
                const double radius = (0.34 + 1.25 * along) * (1 + 0.45 * lumps);
                return std::max(0.0, 1 - std::pow(across / radius, 2.0)) * (1.2 - along);
            }};
}

}  // namespace dustbench::raycast
