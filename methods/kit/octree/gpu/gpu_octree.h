// Builds an octree's voxels on the GPU, from puffs in GPU buffers: the voxels of the CPU's builders, in their order.
//
// Each particle's voxel has a key, its number in pre-order. A stable radix sort by key makes the particles of a voxel
// neighbours, in the order of the store; a compaction finds where each run begins; a thread for each voxel reduces its
// run. The world's place and depth are also chosen on the GPU, because only it knows where the dust is. Nothing is read
// back. Trees of more than 10 levels have keys of two words, and are sorted twice.
//
// Cells, levels, and the particles that represent voxels are those of the CPU on every device: the shaders' decisions
// rest on correctly rounded operations. Sums of masses have the CPU's order within blocks of 16 sorted particles and
// are in double precision.
//
// Units: metres, m². Frame: world. Owns: 75 bytes per particle, 87 with colours, in buffers that grow by doubling.
// Threads: the OpenGL thread's. Source: Carr2006, 3.2 (voxels).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "methods/contract/stage_clock.h"
#include "methods/contract/volume.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree_dust.h"

namespace dustbench::octree {

/// A voxel as read back.
struct GpuVoxel {
    std::uint64_t place;     ///< CellEntry::place
    std::uint32_t particle;  ///< index of the particle that represents it
    float massSquareMetres;

    [[nodiscard]] int rise() const { return 15 - static_cast<int>(place & 15); }
    [[nodiscard]] std::uint64_t code() const { return place >> 4; }
};

/// Numbers of the last frame, and of all frames since the maxima began.
struct GpuOctreeNumbers {
    Lattice lattice;
    std::uint32_t particles = 0, voxels = 0;
    std::uint32_t clipped = 0;     ///< particles outside the world
    std::uint32_t notNumbers = 0;  ///< of them, positions that are not numbers; sum over all frames
    std::uint32_t maximumClipped = 0, maximumVoxels = 0;
    int maximumDepth = 0;
};

class DUSTBENCH_API GpuOctree {
 public:
    explicit GpuOctree(gpu::Device& device);
    ~GpuOctree();
    GpuOctree(const GpuOctree&) = delete;
    GpuOctree& operator=(const GpuOctree&) = delete;

    /// Uses all settings except `sort` and the cross-fade. `maximaBegin`: forgets the maxima of earlier frames.
    /// Measures the steps `keys`, `order`, `runs` and `list`. Throws InputError if the particles do not fit the device.
    void build(const GpuPuffs& dust, const DustSettings& settings, const glm::dvec3& vehicle, bool maximaBegin,
               const StageClock& clock);

    /// The voxels in pre-order, as puffs without life and serials: `look` is radius and opacity of a billboard, or edge
    /// and optical depth of a cube. Valid until the next build.
    [[nodiscard]] const GpuPuffs& drawn() const;

    /// For passes over the voxels: binds the uniform blocks of octree.glsl.
    void bindFrame() const;
    /// Four words each, as GpuVoxel.
    [[nodiscard]] const gpu::Buffer& voxels() const;
    /// A bound on the number of voxels.
    [[nodiscard]] std::uint32_t capacity() const;

    /// Both wait for the GPU.
    [[nodiscard]] GpuOctreeNumbers readNumbers() const;
    [[nodiscard]] std::vector<GpuVoxel> readVoxels() const;
    [[nodiscard]] std::size_t bytes() const;
    /// Bytes of a voxel in the list.
    [[nodiscard]] std::size_t voxelBytes() const;

 private:
    struct Room;
    struct Passes;

    void makeRoom(const GpuPuffs& dust);
    void findWorld(const GpuPuffs& dust);
    void order(const GpuPuffs& dust);
    void findRuns(const GpuPuffs& dust);
    void list(const GpuPuffs& dust);

    gpu::Device& device_;
    std::unique_ptr<Passes> passes_;
    std::unique_ptr<Room> room_;
    GpuPuffs drawn_;
};

}  // namespace dustbench::octree
