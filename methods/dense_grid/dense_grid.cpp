// Dust in a dense grid of voxels, which shows the memory that an octree saves.
#include <fmt/format.h>

#include "methods/contract/errors.h"
#include "methods/dense_grid/grid_builder.h"
#include "methods/kit/octree/octree_dust.h"

namespace dustbench::dense_grid {
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
