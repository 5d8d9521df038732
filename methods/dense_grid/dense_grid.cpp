#include "methods/dense_grid/dense_grid.h"

#include <fmt/format.h>

#include "methods/contract/errors.h"
#include "methods/kit/octree/octree_dust.h"
#include "methods/kit/octree/octree_settings.h"
#include "methods/kit/octree/particle_cells.h"

namespace dustbench::dense_grid {

using namespace octree;
namespace {

constexpr Choices<octree::Render> renders{
    {"billboards", octree::Render::billboards}, {"circles", octree::Render::circles}, {"cubes", octree::Render::cubes}};

/// With this limit, at least the minimum depth is allowed for every policy.
constexpr auto smallestLimit =
    static_cast<std::int64_t>(gridBytes(octree::minimumDepth, octree::OpacityPolicy::accumulate));

/// Throws InputError if the grid has more bytes than the user allows.
void requireWithin(std::int64_t limitBytes, const octree::OctreeSettings& settings) {
    const auto allowed = static_cast<std::uint64_t>(limitBytes);
    const std::uint64_t bytes = gridBytes(settings.depth, settings.policy);
    if (bytes <= allowed) return;
    int deepest = settings.depth;
    while (gridBytes(deepest, settings.policy) > allowed) --deepest;
    throw InputError(
        fmt::format("parameter depth: got {}, a grid of {}³ cells of {} bytes = {} bytes; allowed: {} bytes "
                    "(limit_bytes), which is depth {} or less",
                    settings.depth, octree::Lattice::cellsPerEdge(settings.depth), cellBytes(settings.policy), bytes,
                    allowed, deepest));
}

octree::DustSettings settingsOf(const ParameterValues& values) {
    octree::DustSettings settings;
    settings.tree.depth = static_cast<int>(values.integer("depth"));
    settings.tree.levels = 1;
    settings.tree.policy = values.choice("policy", octree::opacityPolicies);
    settings.render = values.choice("render", renders);
    settings.sort = values.choice("sort", draw::sortKinds);
    settings.opacity = values.choice("opacity", draw::opacityOrigins);
    settings.youngOpacity = values.real("young_opacity");
    settings.worldEdgeMetres = values.real("world_edge");
    settings.worldGrows = false;
    requireWithin(values.integer("limit_bytes"), settings.tree);
    return settings;
}

}  // namespace

GridBuilder::GridBuilder(MemoryLedger& ledger)
    : active_(ledger.account("active particles")),
      cells_(ledger.account("dense grid")),
      masses_(ledger.account("dense grid")) {}

void GridBuilder::clear(int depth, bool withMasses) {
    const std::size_t cells = std::size_t{1} << 3 * depth;
    cells_.assign(cells, 0);
    masses_.assign(withMasses ? cells : 0, 0);
}

/// Visits every cell.
void GridBuilder::list(Octree& tree) const {
    std::uint32_t count = 0;
    for (std::uint64_t code = 0; code < cells_.size(); ++code) {
        if (cells_[code] == 0) continue;
        if (!masses_.empty()) tree.mutableMasses()[count] = masses_[code];
        tree.mutableVoxels()[count++] = CellEntry(code, 0, cells_[code] - 1);
    }
}

std::int64_t GridBuilder::build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                                Octree& tree) {
    const ParticlePlace place(store, lattice, settings);
    const VoxelRule rule(store, settings.policy);
    const std::int64_t clipped = listActive(store, place, active_);
    clear(settings.depth, rule.accumulates());
    std::size_t count = 0;
    for (const std::uint32_t particle : active_) {
        const glm::uvec3 at(glm::floor(place.cells(particle)) - place.corner());
        const std::uint64_t code = mortonCode(at.x, at.y, at.z);
        std::uint32_t& cell = cells_[code];
        count += cell == 0 ? 1 : 0;
        if (cell == 0 || rule.wins(particle, cell - 1)) cell = particle + 1;
        if (rule.accumulates()) masses_[code] += rule.massSquareMetres(particle);
    }
    tree.clear(settings.depth);
    tree.setVoxels(count, rule.accumulates());
    list(tree);
    return clipped;
}

std::size_t GridBuilder::structureBytes(const Octree&) const {
    return cells_.size() * sizeof(std::uint32_t) + masses_.size() * sizeof(double);
}

MethodInfo describe() {
    MethodInfo info;
    info.title = "Dense grid dust";
    info.summary = "Voxels as in an octree's finest level, stored in a grid of all cells, empty ones included.";
    info.source = "Carr2006";
    info.takesLights = true;
    info.parameters
        .integer("depth", 8, octree::minimumDepth, octree::maximumDepth, "levels",
                 "number of times the world's edge is halved: 2^depth cells along each axis")
        .choice("policy", octree::OpacityPolicy::max, octree::opacityPolicies,
                "voxels with several particles show the most opaque one, the youngest one, or the sum of their masses")
        .choice("render", octree::Render::billboards, renders,
                "draw a voxel as a smoothly faded circle of its optical depth, as a plain circle (paper), or as a cube")
        .choice("sort", draw::SortKind::radix, draw::sortKinds,
                "order in which voxels are blended: far to near by the paper's quicksort or by a radix sort, or in the "
                "order of the grid")
        .real("world_edge", 128, 1, 1e5, "m", "edge of the grid, a cube that follows the vehicle")
        .integer("limit_bytes", std::int64_t{2} << 30, smallestLimit, std::int64_t{1} << 40, "bytes",
                 "maximum size of the grid; a depth that needs more is refused");
    draw::declareOpacity(info.parameters);
    info.parameters.choice("mode", "fixed", {"fixed", "paper"}, "draw by the optical model, or as in the paper")
        .preset("mode", "paper", {{"opacity", "age"}, {"render", "circles"}, {"sort", "quicksort"}});
    octree::declareDustFacts(info);
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        return std::make_unique<octree::OctreeDust>(
            settingsOf(values), [](MemoryLedger& ledger) { return std::make_unique<GridBuilder>(ledger); });
    };
    return info;
}

}  // namespace dustbench::dense_grid
