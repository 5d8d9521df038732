#include "bench/export/extinction_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/export/exporter.h"
#include "methods/contract/errors.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::exports {
namespace {

constexpr double reachDeviations = 5;
constexpr int slabCells = 4;

/// Both shapes are a mass times a distribution along each axis; `below` is the share of the mass below a coordinate.
/// The average over a cell is mass / volume · Π over the axes of [below(end) − below(beginning)].
struct GaussianShape {
    glm::dvec3 centre;
    double reachMetres;
    double scale;  ///< 1 / (√2·s)
    double massSquareMetres;

    explicit GaussianShape(const CollectedPuff& puff)
        : centre(puff.centre),
          reachMetres(reachDeviations * maths::puffDeviationMetres(static_cast<double>(puff.radiusMetres))),
          scale(reachDeviations / (std::numbers::sqrt2 * reachMetres)),
          massSquareMetres(
              maths::puffMassSquareMetres(static_cast<double>(puff.opacity), static_cast<double>(puff.radiusMetres))) {}
    [[nodiscard]] double begin(int axis) const { return centre[axis] - reachMetres; }
    [[nodiscard]] double end(int axis) const { return centre[axis] + reachMetres; }
    [[nodiscard]] double below(int axis, double coordinate) const {
        return 0.5 * std::erf((coordinate - centre[axis]) * scale);
    }
};

struct CubeShape {
    glm::dvec3 corner;
    double edgeMetres;
    double massSquareMetres;

    [[nodiscard]] double begin(int axis) const { return corner[axis]; }
    [[nodiscard]] double end(int axis) const { return corner[axis] + edgeMetres; }
    [[nodiscard]] double below(int axis, double coordinate) const {
        return std::clamp((coordinate - corner[axis]) / edgeMetres, 0.0, 1.0);
    }
};

CubeShape cubeOf(const CollectedOctree& octree, const OctreeVoxel& voxel) {
    const double edge = octree.cellEdgeMetres(voxel.level);
    return {octree.minimumCorner(voxel), edge, static_cast<double>(voxel.extinctionPerMetre) * edge * edge * edge};
}

/// The cells along one axis that a shape reaches, and its share in each.
struct Run {
    int first = 0;
    std::vector<float> share;

    /// False if it reaches none of the cells firstCell..endCell.
    template <typename Shape>
    bool fill(const Shape& shape, int axis, const GridPlan& plan, int firstCell, int endCell) {
        const double origin = plan.origin[axis], spacing = plan.spacingMetres;
        const auto held = [&](double cell) {
            return static_cast<int>(std::clamp(cell, static_cast<double>(firstCell), static_cast<double>(endCell)));
        };
        first = held(std::floor((shape.begin(axis) - origin) / spacing));
        const int end = held(std::ceil((shape.end(axis) - origin) / spacing));
        if (first >= end) return false;
        share.resize(static_cast<std::size_t>(end - first));
        double before = shape.below(axis, origin + first * spacing);
        for (int cell = first; cell < end; ++cell) {
            const double after = shape.below(axis, origin + (cell + 1) * spacing);
            share[static_cast<std::size_t>(cell - first)] = static_cast<float>(after - before);
            before = after;
        }
        return true;
    }
};

/// The part of the grid between two z layers. Shapes are added one after the other.
class Slab {
 public:
    Slab(ExtinctionGrid& grid, int firstLayer, int endLayer)
        : plan_(grid.plan), values_(grid.extinctionPerMetre), firstLayer_(firstLayer), endLayer_(endLayer) {}

    template <typename Shape>
    void add(const Shape& shape) {
        if (!along_[2].fill(shape, 2, plan_, firstLayer_, endLayer_)) return;
        if (!along_[1].fill(shape, 1, plan_, 0, plan_.cells[1])) return;
        if (!along_[0].fill(shape, 0, plan_, 0, plan_.cells[0])) return;
        const double spacing = plan_.spacingMetres;
        const auto density = static_cast<float>(shape.massSquareMetres / (spacing * spacing * spacing));
        const std::size_t count = along_[0].share.size();
        const float* const shareX = along_[0].share.data();
        for (std::size_t k = 0; k < along_[2].share.size(); ++k)
            for (std::size_t j = 0; j < along_[1].share.size(); ++j) {
                const float factor = density * along_[2].share[k] * along_[1].share[j];
                float* const row =
                    &values_[offset(along_[1].first + static_cast<int>(j), along_[2].first + static_cast<int>(k))];
                for (std::size_t i = 0; i < count; ++i) row[i] += factor * shareX[i];
            }
    }

    /// Adds a grid cell by cell, only the layers that overlap the slab.
    void add(const CollectedGrid& grid) {
        const double edge = grid.spacingMetres;
        const double minimum = plan_.origin[2] + firstLayer_ * plan_.spacingMetres - grid.originMetres.z;
        const double maximum = plan_.origin[2] + endLayer_ * plan_.spacingMetres - grid.originMetres.z;
        const auto held = [&](double layer) {
            return static_cast<int>(std::clamp(layer, 0.0, static_cast<double>(grid.cells.z)));
        };
        const int end = held(std::ceil(maximum / edge));
        for (int k = held(std::floor(minimum / edge)); k < end; ++k)
            for (int j = 0; j < grid.cells.y; ++j)
                for (int i = 0; i < grid.cells.x; ++i) {
                    const float extinction = grid.extinctionPerMetre[grid.row(j, k) + static_cast<std::size_t>(i)];
                    if (extinction == 0) continue;
                    add(CubeShape{grid.originMetres + glm::dvec3(i, j, k) * edge, edge,
                                  static_cast<double>(extinction) * edge * edge * edge});
                }
    }

 private:
    [[nodiscard]] std::size_t offset(int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(plan_.cells[1]) + static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(plan_.cells[0]) +
               static_cast<std::size_t>(along_[0].first);
    }

    const GridPlan& plan_;
    std::vector<float>& values_;
    int firstLayer_, endLayer_;
    std::array<Run, 3> along_;
};

/// Exact bytes, and gibibytes in brackets.
std::string bytesText(std::int64_t bytes) {
    return fmt::format("{} bytes ({:.1f} GiB)", bytes, static_cast<double>(bytes) / (1 << 30));
}

}  // namespace

GridPlan planGrid(const std::optional<Box>& box, int resolution) {
    GridPlan plan;
    if (!box) return plan;
    const glm::dvec3 extent = box->extent();
    plan.origin = box->minimum;
    plan.spacingMetres = std::max({extent.x, extent.y, extent.z}) / resolution;
    for (int axis = 0; axis < 3; ++axis) {
        // A rounding excess over a whole number of cells does not need another cell.
        const double cells = std::ceil(extent[axis] / plan.spacingMetres - 1e-9);
        plan.cells[static_cast<std::size_t>(axis)] = std::clamp(static_cast<int>(cells), 1, resolution);
    }
    return plan;
}

void requireMemory(const GridPlan& plan, const VolumeSettings& settings, std::int64_t availableBytes) {
    bool needsGrid = false;
    int tenths = 0;  // one format is written after the other
    for (const std::string& format : settings.formats) {
        const Exporter& exporter = exporterOf(format);
        needsGrid = needsGrid || exporter.writeGrid;
        tenths = std::max(tenths, exporter.gridTenths);
    }
    if (!needsGrid) return;
    const std::int64_t needed = plan.bytes() + plan.bytes() / 10 * tenths;
    if (needed <= availableBytes) return;
    throw InputError(
        fmt::format("resolution: a grid of {}x{}x{} cells needs {}, but only {} are available; allowed: "
                    "a lower --resolution or a flatter --region",
                    plan.cells[0], plan.cells[1], plan.cells[2], bytesText(needed), bytesText(availableBytes)));
}

double ExtinctionGrid::massSquareMetres() const {
    double sum = 0;
    for (const float extinction : extinctionPerMetre) sum += static_cast<double>(extinction);
    return sum * plan.spacingMetres * plan.spacingMetres * plan.spacingMetres;
}

ExtinctionGrid computeGrid(const CollectedVolume& volume, const GridPlan& plan) {
    ExtinctionGrid grid{plan, std::vector<float>(static_cast<std::size_t>(plan.cellCount()))};
    // Each cell sums its contributions in the order of the shapes, whichever slab it is in.
    parallel::forEachBlock(static_cast<std::size_t>(plan.cells[2]), slabCells,
                           [&](std::size_t first, std::size_t count) {
                               Slab slab(grid, static_cast<int>(first), static_cast<int>(first + count));
                               for (const CollectedPuff& puff : volume.puffs()) slab.add(GaussianShape(puff));
                               for (const CollectedOctree& octree : volume.octrees())
                                   for (const OctreeVoxel& voxel : octree.voxels) slab.add(cubeOf(octree, voxel));
                               for (const CollectedGrid& each : volume.grids()) slab.add(each);
                           });
    return grid;
}

}  // namespace dustbench::exports
