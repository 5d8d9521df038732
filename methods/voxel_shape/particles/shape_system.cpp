#include "methods/voxel_shape/particles/shape_system.h"

#include <algorithm>
#include <array>
#include <utility>

#include "methods/kit/maths/hash.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {
namespace {

/// Particles per block of a thread: smaller blocks do not pay off, and the kernel prefetches only within a block.
constexpr std::size_t blockSize = 4 * particles::chunkSize;

/// Lists the flagged particles of a block, chunk by chunk.
void note(particles::NotedParticles& list, std::size_t first, std::span<const std::uint8_t> flags) {
    for (std::size_t done = 0; done < flags.size(); done += particles::chunkSize)
        list.note((first + done) / particles::chunkSize, flags.data() + done,
                  std::min(particles::chunkSize, flags.size() - done));
}

}  // namespace

ShapeSystem::ShapeSystem(MemoryLedger& ledger, const MarkedVoxels& marked, const Voxel& pattern, std::uint64_t seed)
    : grid_(ledger, marked, pattern),
      particles_(ledger),
      deaths_(ledger),
      arriving_(ledger.account("arrivals")),
      arrivals_(ledger, "arrivals"),
      targets_(ledger.account("arrivals")),
      emission_(ledger, seed) {}

ShapeSystem::ShapeSystem(MemoryLedger& ledger, VoxelGrid grid, std::uint64_t seed)
    : grid_(std::move(grid)),
      particles_(ledger),
      deaths_(ledger),
      arriving_(ledger.account("arrivals")),
      arrivals_(ledger, "arrivals"),
      targets_(ledger.account("arrivals")),
      emission_(ledger, seed) {}

void ShapeSystem::live(const Motion& motion, float stepSeconds) {
    const KernelStep step(grid_, pose_, motion, stepSeconds);
    deaths_.prepare(particles_.size());
    arrivals_.prepare(particles_.size());
    arriving_.resize(particles_.size());
    const std::span<std::uint8_t> arriving = arriving_;
    parallel::forEachBlock(particles_.size(), blockSize, [&](std::size_t first, std::size_t count) {
        std::array<std::uint8_t, blockSize> dead;
        updateParticles(particles_, first, count, grid_, step, dead.data(), &arriving[first]);
        note(deaths_, first, {dead.data(), count});
    });
    parallel::forEachBlock(particles_.size(), blockSize, [&](std::size_t first, std::size_t count) {
        if (motion.fullVoxelsRefuse) dropWhereFull(particles_, first, count, grid_.voxels(), &arriving[first]);
        note(arrivals_, first, arriving.subspan(first, count));
    });
    const std::span<const std::uint32_t> arrivals = arrivals_.collect();
    targets_.resize(arrivals.size());
    admit(particles_, arrivals, targets_, grid_.voxels(), motion.fullVoxelsRefuse);
}

/// Fills the holes (ascending) with the last particles.
void ShapeSystem::bury(std::span<const std::uint32_t> holes) {
    std::size_t end = particles_.size();
    std::size_t lastHole = holes.size();
    for (std::size_t hole = 0; hole < lastHole; ++hole) {
        while (lastHole > hole && holes[lastHole - 1] == end - 1) {
            --lastHole;
            --end;
        }
        if (hole >= lastHole) break;
        particles_.move(--end, holes[hole]);
    }
    particles_.resize(end);
}

ShapeCount ShapeSystem::count() const {
    ShapeCount count;
    for (const std::uint32_t i : grid_.active()) {
        const Voxel& voxel = grid_.voxels()[i];
        count.inside += voxel.density;
        if (voxel.isOn()) count.room += voxel.maximumDensity;
    }
    count.fading = particles_.size() - count.inside;
    return count;
}

void ShapeSystem::step(const Pose& pose, const Motion& motion, float stepSeconds) {
    live(motion, stepSeconds);
    replace(pose, motion, stepSeconds);
}

void ShapeSystem::replace(const Pose& pose, const Motion& motion, float stepSeconds) {
    pose_ = pose;
    bury(deaths_.collect());
    emission_.emit(particles_, grid_, pose, motion, stepSeconds);
}

std::uint64_t ShapeSystem::stateHash() const {
    return maths::Hash().add(particles_.hash()).add(grid_.hash()).value();
}

}  // namespace dustbench::voxel_shape
