#include "methods/voxel_shape/voxels/voxel_grid.h"

#include <array>

#include "methods/contract/errors.h"
#include "methods/kit/maths/hash.h"
#include "methods/kit/memory/available_memory.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/voxel_shape/voxels/solid_fill.h"

namespace dustbench::voxel_shape {
namespace {

constexpr int reach = 2;
constexpr std::size_t voxelsABlock = 256;

/// Returns −Σ d/|d|² over the matter at offsets d within reach.
glm::vec3 awayFromMatter(const MarkedVoxels& matter, const glm::ivec3& cell) {
    glm::vec3 sum(0);
    for (int z = -reach; z <= reach; ++z)
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const glm::ivec3 d(x, y, z);
                if (d == glm::ivec3(0) || !matter.lattice.contains(cell + d)) continue;
                const glm::vec3 along(d);
                if (matter.marked[matter.lattice.index(cell + d)]) sum -= along / glm::dot(along, along);
            }
    return sum;
}

constexpr int reachOfRows = 3, windowOfRows = 2 * reachOfRows + 1;
constexpr float thinnest = 0.1f;  ///< variance across a row by that along it

/// The active cells that touch each other, from `cell` to `reachOfRows` away, relative to `cell`.
std::vector<glm::vec3> touching(const VoxelGrid& grid, const glm::ivec3& cell) {
    std::array<bool, static_cast<std::size_t>(windowOfRows * windowOfRows * windowOfRows)> seen{};
    const auto seenAt = [&](const glm::ivec3& d) -> bool& {
        const glm::ivec3 w = d + reachOfRows;
        return seen[static_cast<std::size_t>((w.z * windowOfRows + w.y) * windowOfRows + w.x)];
    };
    std::vector<glm::ivec3> rest{glm::ivec3(0)};
    std::vector<glm::vec3> found;
    seenAt(rest.front()) = true;
    while (!rest.empty()) {
        const glm::ivec3 from = rest.back();
        rest.pop_back();
        found.emplace_back(from);
        for (int step = 0; step < 27; ++step) {
            const glm::ivec3 d = from + glm::ivec3(step % 3, step / 3 % 3, step / 9) - 1;
            if (glm::any(glm::greaterThan(glm::abs(d), glm::ivec3(reachOfRows))) || seenAt(d)) continue;
            seenAt(d) = true;
            if (grid.lattice().contains(cell + d) && grid.at(cell + d).isActive()) rest.push_back(d);
        }
    }
    return found;
}

glm::vec3 rowAt(const VoxelGrid& grid, const glm::ivec3& cell) {
    const std::vector<glm::vec3> cells = touching(grid, cell);
    glm::vec3 mean(0);
    for (const glm::vec3& each : cells) mean += each / static_cast<float>(cells.size());
    glm::mat3 spread(0);
    for (const glm::vec3& each : cells) spread += glm::outerProduct(each - mean, each - mean);
    const glm::vec3 variances(spread[0][0], spread[1][1], spread[2][2]);
    const int widest =
        variances.x >= variances.y ? (variances.x >= variances.z ? 0 : 2) : (variances.y >= variances.z ? 1 : 2);
    const float all = variances.x + variances.y + variances.z;
    if (!(all > 0)) return glm::vec3(0);
    glm::vec3 axis = spread[widest];  // the power method: the principal axis of a row is far longer than the others
    for (int turn = 0; turn < 16; ++turn) axis = spread * glm::normalize(axis);
    const float along = glm::length(axis);
    if (all - along > thinnest * along) return glm::vec3(0);
    return axis[widest] < 0 ? -axis / along : axis / along;
}

}  // namespace

VoxelGrid::VoxelGrid(MemoryLedger& ledger, const Lattice& lattice)
    : lattice_(lattice), voxels_(ledger.account("voxels")), active_(ledger.account("active voxels")) {
    requireAvailable("voxels", lattice.size() * sizeof(Voxel));
    voxels_.resize(lattice.size());
}

VoxelGrid::VoxelGrid(MemoryLedger& ledger, const MarkedVoxels& marked, const Voxel& pattern)
    : VoxelGrid(ledger, marked.lattice) {
    const float opacity = pattern.colour.colour().a;
    for (std::size_t i = 0; i < voxels_.size(); ++i) {
        if (!marked.marked[i]) continue;
        voxels_[i] = pattern;
        voxels_[i].colour = PackedColour(glm::vec4(marked.colours[i], opacity));
        voxels_[i].setActive(true);
    }
    listActive();
}

void VoxelGrid::listActive() {
    active_.clear();
    for (std::size_t i = 0; i < voxels_.size(); ++i)
        if (voxels_[i].isActive()) active_.push_back(static_cast<std::uint32_t>(i));
    active_.shrink_to_fit();
}

void VoxelGrid::shareOut(std::uint32_t particles) {
    if (active_.empty()) throw InputError("voxel shape: got no active voxel, expected at least one to hold particles");
    const std::uint64_t voxels = active_.size();
    for (std::uint64_t k = 0; k < voxels; ++k)
        voxels_[active_[k]].maximumDensity =
            static_cast<std::uint32_t>((k + 1) * particles / voxels - k * particles / voxels);
}

std::uint64_t VoxelGrid::hash() const {
    return maths::Hash().add(std::span<const Voxel>(voxels_)).value();
}

std::vector<glm::vec3> normalsOf(const VoxelGrid& grid) {
    MarkedVoxels matter(grid.lattice());
    for (const std::uint32_t i : grid.active()) matter.marked[i] = 1;
    (void)markInside(matter);
    std::vector<glm::vec3> normals(grid.active().size(), glm::vec3(0));
    parallel::forEachBlock(normals.size(), voxelsABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k) {
            const glm::vec3 away = awayFromMatter(matter, grid.lattice().cell(grid.active()[k]));
            const float length = glm::length(away);
            if (length > 1e-3f) normals[k] = away / length;
        }
    });
    return normals;
}

std::vector<glm::vec3> rowsOf(const VoxelGrid& grid) {
    std::vector<glm::vec3> rows(grid.active().size());
    parallel::forEachBlock(rows.size(), voxelsABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k)
            rows[k] = rowAt(grid, grid.lattice().cell(grid.active()[k]));
    });
    return rows;
}

}  // namespace dustbench::voxel_shape
