#include "methods/voxel_shape/voxels/voxel_grid.h"

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

}  // namespace dustbench::voxel_shape
