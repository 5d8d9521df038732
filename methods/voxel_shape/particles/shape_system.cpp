#include "methods/voxel_shape/particles/shape_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "methods/kit/maths/hash.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {
namespace {

constexpr std::size_t voxelsABlock = 4096;
enum Stream : std::uint32_t { fillStream = 1, placeStream, velocityStream };
/// An animation starts at one of this many pictures.
constexpr float firstPictures = 64;

/// Returns `lacking`·`share`, rounded up with the probability of its fraction: `uniform` is in [0, 1).
std::uint32_t birthsOf(std::uint32_t lacking, float share, float uniform) {
    return std::min(lacking, static_cast<std::uint32_t>(static_cast<float>(lacking) * share + uniform));
}

/// Returns the velocity, in the shape's frame, of a particle that is born at `r` from the centre of a rotating voxel.
glm::vec3 rotationAt(const Voxel& voxel, const glm::vec3& r) {
    const glm::vec3 t = glm::cross(voxel.force, r);
    switch (voxel.forceKind()) {
        case Force::linear:
        case Force::gravity:
            return glm::vec3(0);
        case Force::orbit: {
            // A circular orbit: speed |ω|·|r|, perpendicular to r and the axis.
            const float across = glm::length(t);
            return across > 0 ? t * (glm::length(voxel.force) * glm::length(r) / across) : glm::vec3(0);
        }
        case Force::spiral:
            return t - voxel.forceNumber * glm::cross(voxel.force, t);
        case Force::helix:
            return t + voxel.forceNumber * voxel.force;
    }
    return glm::vec3(0);
}

/// Particles per block of a thread: smaller blocks do not pay off, and the kernel prefetches only within a block.
constexpr std::size_t blockSize = 4 * particles::chunkSize;

/// Lists the flagged particles of a block, chunk by chunk.
void note(particles::NotedParticles& list, std::size_t first, std::span<const std::uint8_t> flags) {
    for (std::size_t done = 0; done < flags.size(); done += particles::chunkSize)
        list.note((first + done) / particles::chunkSize, flags.data() + done,
                  std::min(particles::chunkSize, flags.size() - done));
}

}  // namespace

Emission::Emission(MemoryLedger& ledger, std::uint64_t seed)
    : seed_(seed), births_(ledger.account("births")), starts_(ledger.account("births")) {}

/// Returns the number of births in all voxels.
std::size_t Emission::countBirths(const VoxelGrid& grid, float share) {
    const std::span<const std::uint32_t> active = grid.active();
    const std::span<const Voxel> voxels = grid.voxels();
    births_.resize(active.size());
    starts_.assign((active.size() + voxelsABlock - 1) / voxelsABlock + 1, 0);
    parallel::forEachBlock(active.size(), voxelsABlock, [&](std::size_t first, std::size_t count) {
        std::size_t sum = 0;
        for (std::size_t k = first; k < first + count; ++k) {
            const Voxel& voxel = voxels[active[k]];
            std::uint32_t births =
                voxel.isOn() ? voxel.maximumDensity - std::min(voxel.density, voxel.maximumDensity) : 0;
            if (births > 0 && share < 1)
                births = birthsOf(births, share, maths::uniform4(seed_, fillStream, active[k], steps_)[0]);
            births_[k] = births;
            sum += births;
        }
        starts_[first / voxelsABlock + 1] = sum;
    });
    for (std::size_t block = 1; block < starts_.size(); ++block) starts_[block] += starts_[block - 1];
    return starts_.back();
}

void Emission::emit(ShapeParticles& particles, VoxelGrid& grid, const Pose& pose, const Motion& motion,
                    float stepSeconds) {
    const std::size_t born = countBirths(grid, motion.fillSeconds > stepSeconds ? stepSeconds / motion.fillSeconds : 1);
    ++steps_;
    if (born == 0) return;

    const std::span<const std::uint32_t> active = grid.active();
    const std::span<Voxel> voxels = grid.voxels();
    const std::size_t before = particles.size();
    particles.resize(before + born);
    particles::ParticleStore& store = particles.store;
    const Lattice& lattice = grid.lattice();
    parallel::forEachBlock(active.size(), voxelsABlock, [&](std::size_t first, std::size_t count) {
        std::size_t number = starts_[first / voxelsABlock];
        if (starts_[first / voxelsABlock + 1] == number) return;
        for (std::size_t k = first; k < first + count; ++k) {
            const std::uint32_t births = births_[k];
            if (births == 0) continue;
            Voxel& voxel = voxels[active[k]];
            voxel.density += births;
            const glm::vec3 cell(lattice.cell(active[k]));
            const glm::vec4 colour = voxel.colour.colour();
            for (std::uint32_t b = 0; b < births; ++b, ++number) {
                const std::size_t i = before + number;
                const std::uint64_t serial = nextSerial_ + number;
                const auto place = maths::uniform4(seed_, placeStream, serial);
                const auto toss = maths::uniform4(seed_, velocityStream, serial);
                const glm::vec3 within(place[0], place[1], place[2]);
                const glm::vec3 local = lattice.origin + lattice.edgeMetres * (cell + within);
                const glm::vec3 world = pose.toWorld(local);
                const glm::vec3 turning = rotationAt(voxel, lattice.edgeMetres * pose.scale * (within - 0.5f));
                const glm::vec3 velocity =
                    pose.velocityAt(world) + pose.rotation * turning +
                    motion.birthSpeed * std::cbrt(toss[2]) * maths::sphereDirection(toss[0], toss[1]);
                store.serial[i] = serial;
                store.x[i] = world.x;
                store.y[i] = world.y;
                store.z[i] = world.z;
                store.velocityX[i] = velocity.x;
                store.velocityY[i] = velocity.y;
                store.velocityZ[i] = velocity.z;
                store.age[i] = 0;
                store.lifetime[i] = voxel.lifetimeSeconds;
                store.radius[i] = voxel.sizeMetres;
                store.opacity[i] = colour.a;
                store.red[i] = colour.r;
                store.green[i] = colour.g;
                store.blue[i] = colour.b;
                particles.place[i] = active[k];
                particles.settlingSeconds[i] = 0;
                particles.picture[i] = std::floor(firstPictures * place[3]);
                particles.pictureSpeed[i] = voxel.picturesPerSecond;
                if (particles.keepsBirthplaces()) particles.birthplace[i] = local;
            }
        }
    });
    nextSerial_ += born;
}

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
