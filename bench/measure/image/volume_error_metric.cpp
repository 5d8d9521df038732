#include "bench/measure/image/volume_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/measure/image/metric.h"
#include "methods/contract/errors.h"

namespace dustbench::measure {
namespace {

void requireWhole(const GridCells& grid, const char* name) {
    std::size_t expected = 1;
    for (const int cells : grid.cells) expected *= static_cast<std::size_t>(std::max(cells, 0));
    if (expected == 0 || grid.extinctionPerMetre.size() != expected)
        throw InputError(fmt::format("{}: got {} cells, expected {}x{}x{}", name, grid.extinctionPerMetre.size(),
                                     grid.cells[0], grid.cells[1], grid.cells[2]));
    const auto bad = std::ranges::count_if(grid.extinctionPerMetre, [](float value) { return !std::isfinite(value); });
    if (bad > 0) throw InputError(fmt::format("{}: {} cells are not finite", name, bad));
}

}  // namespace

Measured volumeError(const GridCells& reference, const GridCells& grid) {
    requireWhole(reference, "the reference's grid");
    requireWhole(grid, "the grid");
    if (reference.cells != grid.cells)
        throw InputError(fmt::format("grids differ in size: the reference has {}x{}x{} cells, the other has {}x{}x{}",
                                     reference.cells[0], reference.cells[1], reference.cells[2], grid.cells[0],
                                     grid.cells[1], grid.cells[2]));
    const auto nx = static_cast<std::size_t>(grid.cells[0]), ny = static_cast<std::size_t>(grid.cells[1]);
    std::vector<double> columns(nx * static_cast<std::size_t>(grid.cells[2]), 0.0);
    double differences = 0, squares = 0;
    for (std::size_t i = 0; i < grid.extinctionPerMetre.size(); ++i) {
        const auto a = static_cast<double>(grid.extinctionPerMetre[i]);
        const auto b = static_cast<double>(reference.extinctionPerMetre[i]);
        columns[i % nx + nx * (i / (nx * ny))] += (a - b) * (a - b);
        differences += (a - b) * (a - b);
        squares += b * b;
    }
    Measured result{{}, Plane(grid.cells[0], grid.cells[2])};
    if (squares == 0) return result;
    result.value = std::sqrt(differences / squares);
    for (std::size_t i = 0; i < columns.size(); ++i)
        result.map.values[i] = static_cast<float>(std::sqrt(columns[i] / squares));
    return result;
}

namespace volume_error_metric {

MetricGroup describe() {
    return {
        .metrics = {{.column = "volume_error",
                     .title = "distance of the method's volume from that of the particles; 0: none",
                     .definition = "‖a − b‖ / ‖b‖ over the cells of the grids of extinction: the particles' default "
                                   "export grid, 128 cells along its longest edge",
                     .range = "0 …",
                     .emptyWhen = "the reference's grid is empty",
                     .perfect = "0",
                     .chartName = "volume error",
                     .isFlaw = true,
                     .needs = Needs::grids,
                     .place = 22,
                     .round = 1}},
        .ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
            return {volumeError(*moment.referenceGrid, *moment.grid).value};
        }};
}

}  // namespace volume_error_metric

}  // namespace dustbench::measure
