#include "methods/kit/volumes/grid_place.h"

#include <fmt/format.h>

#include <cmath>

#include "methods/contract/errors.h"

namespace dustbench::volumes {
namespace {

constexpr double sameWithin = 1e-4;  ///< of a cell: grids with a smaller difference count as equal
constexpr double farthestCells = 5e8;

/// Returns the offset of the second grid in cells of the first.
glm::dvec3 shift(const GridPlace& a, const GridPlace& b) {
    return (b.origin - a.origin) / a.spacing;
}

bool onOneLattice(const GridPlace& a, const GridPlace& b) {
    const glm::dvec3 cells = shift(a, b), off = glm::abs(cells - glm::round(cells));
    return std::abs(b.spacing / a.spacing - 1) < sameWithin && off.x < sameWithin && off.y < sameWithin &&
           off.z < sameWithin && glm::all(glm::lessThan(glm::abs(cells), glm::dvec3(farthestCells)));
}

std::string describe(const GridPlace& g) {
    return fmt::format("{}x{}x{} cells of {:.6g} m from ({:.6g}, {:.6g}, {:.6g})", g.cells.x, g.cells.y, g.cells.z,
                       g.spacing, g.origin.x, g.origin.y, g.origin.z);
}

}  // namespace

glm::ivec3 firstCell(const GridPlace& lead, const GridPlace& grid) {
    return glm::ivec3(glm::round(shift(lead, grid)));
}

GridPlace enclosing(const GridPlace& a, const GridPlace& b) {
    const glm::ivec3 first = firstCell(a, b), low = glm::min(glm::ivec3(0), first),
                     high = glm::max(a.cells, first + b.cells);
    GridPlace both = a;
    both.cells = high - low;
    both.origin = a.origin + a.spacing * glm::dvec3(low);
    return both;
}

void requireGoesOn(const GridPlace& grid, const std::filesystem::path& name, const GridPlace* before,
                   const std::filesystem::path& beforeName, const GridPlace& first,
                   const std::filesystem::path& firstName, bool anyCells) {
    if (!grid.timeSeconds) throw InputError(name.string() + ": has no time, but files of a series need one");
    if (before && !(*grid.timeSeconds > *before->timeSeconds))
        throw InputError(fmt::format("{}: its time is {} s, expected more than {} s, the time of {}", name.string(),
                                     *grid.timeSeconds, *before->timeSeconds, beforeName.filename().string()));
    const bool isSame = onOneLattice(first, grid) &&
                        (anyCells || (first.cells == grid.cells && firstCell(first, grid) == glm::ivec3(0)));
    if (!isSame)
        throw InputError(fmt::format("{}: is on a different grid from {}: got {}, expected {}", name.string(),
                                     firstName.filename().string(), describe(grid), describe(first)));
}

}  // namespace dustbench::volumes
