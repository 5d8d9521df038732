// A cloud's extinction on a regular grid of cubic cells. Each cell holds its exact average, so the sum over the cells
// conserves the cloud's mass at any resolution.
//
// Units: metres, extinction per metre. Frame: world.
// Threads: computing uses the current oneTBB arena; the result is bit-identical at any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "bench/export/collected_volume.h"
#include "bench/export/volume_settings.h"

namespace dustbench::exports {

/// Placement of a grid. It has a whole number of cells, so it may extend up to one cell beyond the requested region on
/// the side of larger coordinates.
struct GridPlan {
    glm::dvec3 origin{0};  ///< minimum corner of the first cell
    double spacingMetres = 1;
    std::array<int, 3> cells{1, 1, 1};

    bool operator==(const GridPlan&) const = default;
    [[nodiscard]] std::int64_t cellCount() const { return std::int64_t{cells[0]} * cells[1] * cells[2]; }
    [[nodiscard]] std::int64_t bytes() const { return cellCount() * static_cast<std::int64_t>(sizeof(float)); }
};

/// `resolution` cells along the longest edge. An empty cloud (no box) gives one empty cell of 1 m at the world's
/// origin.
[[nodiscard]] GridPlan planGrid(const std::optional<Box>& box, int resolution);

/// Throws InputError with both numbers if the requested formats need more than `availableBytes` for such a grid.
void requireMemory(const GridPlan& plan, const VolumeSettings& settings, std::int64_t availableBytes);

struct ExtinctionGrid {
    GridPlan plan;
    std::vector<float> extinctionPerMetre;  ///< x fastest, then y

    /// ∫ extinction dV over the grid, m².
    [[nodiscard]] double massSquareMetres() const;
};

/// Cell averages of puffs (to 5s, which omits less than one part in 10⁵ of a puff's mass) and of voxels, summed in the
/// order in which they were provided.
[[nodiscard]] ExtinctionGrid computeGrid(const CollectedVolume& volume, const GridPlan& plan);

}  // namespace dustbench::exports
