#include "methods/voxel_shape/voxels/voxel_grid.h"

#include "methods/contract/errors.h"
#include "methods/kit/maths/hash.h"
#include "methods/kit/memory/available_memory.h"

namespace dustbench::voxel_shape {

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

}  // namespace dustbench::voxel_shape
