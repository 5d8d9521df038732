// A cloud's extinction on a regular grid of cubic cells: what each cell holds is its exact average, so that the sum
// over the cells keeps the cloud's mass however coarse they are.
//
// Units: metres, extinction per metre. Frame: world.
// Threads: computing uses the current oneTBB arena; the result is the same, bit for bit, at any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "bench/export/collected_volume.h"
#include "bench/export/volume_settings.h"

namespace dustbench::bench {

/// Where a grid lies. It covers a whole number of cells, so it may reach up to a cell beyond what it is to hold, on the
/// side of the greater coordinates.
struct GridPlan {
    glm::dvec3 origin{0};  ///< minimum corner of the first cell
    double spacingMetres = 1;
    std::array<int, 3> cells{1, 1, 1};

    bool operator==(const GridPlan&) const = default;
    [[nodiscard]] std::int64_t cellCount() const { return std::int64_t{cells[0]} * cells[1] * cells[2]; }
    [[nodiscard]] std::int64_t bytes() const { return cellCount() * static_cast<std::int64_t>(sizeof(float)); }
};

/// `resolution` cells along the longest edge. An empty cloud (no box) is one empty cell of 1 m at the world's origin.
[[nodiscard]] GridPlan planGrid(const std::optional<Box>& box, int resolution);

/// Throws InputError with both numbers where the formats asked for need more than `availableBytes` for such a grid.
void requireMemory(const GridPlan& plan, const VolumeSettings& settings, std::int64_t availableBytes);

struct ExtinctionGrid {
    GridPlan plan;
    std::vector<float> extinctionPerMetre;  ///< x fastest, then y

    /// ∫ extinction dV over the grid, m².
    [[nodiscard]] double massSquareMetres() const;
};

/// Cell averages of puffs (to 5s, which leaves out less than a part in 10⁵ of a puff's mass) and of voxels, added up in
/// the order in which they were handed over.
[[nodiscard]] ExtinctionGrid computeGrid(const CollectedVolume& volume, const GridPlan& plan);

}  // namespace dustbench::bench
