#include "methods/voxel_shape/particles/particle_kernel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/noted_particles.h"

namespace dustbench::voxel_shape {
namespace {

constexpr std::uint32_t nowhere = 0xffffffffu;

/// Fewer arrivals are admitted by one thread.
constexpr std::size_t arrivalsInABlock = 2048, partsOfVoxels = 8;

/// Particles per run; every loop passes over one run before the next loop starts.
constexpr std::size_t runSize = 128;

constexpr std::size_t fourWords = 16;
static_assert(offsetof(Voxel, forceNumber) == offsetof(Voxel, force) + 12);
static_assert(offsetof(Voxel, fadingColour) == offsetof(Voxel, colour) + 8);
static_assert(offsetof(Voxel, fadingSizeMetres) == offsetof(Voxel, sizeMetres) + 4);
static_assert(offsetof(Voxel, lifetimeSeconds) == offsetof(Voxel, sizeMetres) + 8);

/// Intermediate results passed between the loops over one run.
struct Scratch {
    // Attributes of the voxel that each particle is in or met last, four numbers per particle in sequence. Plain loads
    // and a few shuffles read sixteen of them; a gather needs one load per number.
    alignas(64) std::array<float, 4 * runSize> force;            ///< vector and number
    alignas(64) std::array<std::uint32_t, 4 * runSize> colours;  ///< inside, and outside (fading)
    alignas(64) std::array<std::uint32_t, 4 * runSize> looks;    ///< size, fading size, lifetime, pictures per second
    std::array<std::uint32_t, runSize> flags;

    std::array<std::uint32_t, runSize> here;    ///< index of the voxel at its position, or `nowhere`
    std::array<float, runSize> rx, ry, rz;      ///< from the voxel's centre, in voxels
    std::array<std::uint8_t, runSize> waits;    ///< 1: still outside the voxel that refused it before
    std::array<std::uint8_t, runSize> changes;  ///< 1: leaves its voxel, or has reached another one
};

/// Gathers the voxels' attributes. Most particles stay in their voxel, so the voxels of the next run are prefetched, up
/// to `end` at most: particles beyond `end` may belong to another thread.
void copyVoxels(const ShapeParticles& particles, std::size_t first, std::size_t count, std::size_t end,
                const Voxel* voxels, Scratch& scratch) {
    const std::uint32_t* const place = particles.place.data();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t ahead = std::min(first + i + runSize, end - 1);
        __builtin_prefetch(voxels + (place[ahead] & ~ShapeParticles::outside));
        const Voxel& voxel = voxels[place[first + i] & ~ShapeParticles::outside];
        // Not the whole voxel: another thread may be changing its density.
        const auto* const bytes = reinterpret_cast<const std::byte*>(&voxel);
        std::memcpy(&scratch.force[4 * i], bytes + offsetof(Voxel, force), fourWords);
        std::memcpy(&scratch.colours[4 * i], bytes + offsetof(Voxel, colour), fourWords);
        std::memcpy(&scratch.looks[4 * i], bytes + offsetof(Voxel, sizeMetres), fourWords);
        scratch.looks[4 * i + 3] = std::bit_cast<std::uint32_t>(voxel.picturesPerSecond);
        scratch.flags[i] = voxel.flags;
    }
}

/// Finds the voxel that contains each particle, by one matrix multiplication. If the voxel is unchanged, the gathered
/// flags show whether the particle may be in it.
void lookUp(const ShapeParticles& particles, std::size_t first, std::size_t count, const KernelStep& step,
            Scratch& scratch) {
    const float* const __restrict x = particles.store.x.data() + first;
    const float* const __restrict y = particles.store.y.data() + first;
    const float* const __restrict z = particles.store.z.data() + first;
    const std::uint32_t* const __restrict place = particles.place.data() + first;
    const std::uint32_t* const __restrict flags = scratch.flags.data();
    std::uint32_t* const __restrict here = scratch.here.data();
    std::uint8_t* const __restrict waits = scratch.waits.data(), * const __restrict changes = scratch.changes.data();
    float *const __restrict rx = scratch.rx.data(), *const __restrict ry = scratch.ry.data(),
                      *const __restrict rz = scratch.rz.data();
    const glm::mat3 m = step.toVoxels;
    const glm::vec3 offset = step.offset, counts(step.counts), maximum = counts - 1.0f;
    const int nx = step.counts.x, ny = step.counts.y;
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
        const float gx = m[0][0] * x[i] + m[1][0] * y[i] + m[2][0] * z[i] + offset.x;
        const float gy = m[0][1] * x[i] + m[1][1] * y[i] + m[2][1] * z[i] + offset.y;
        const float gz = m[0][2] * x[i] + m[1][2] * y[i] + m[2][2] * z[i] + offset.z;
        const bool within = (gx >= 0) & (gy >= 0) & (gz >= 0) & (gx < counts.x) & (gy < counts.y) & (gz < counts.z);
        // Clamp, so that the index is valid.
        const int cx = static_cast<int>(gx > 0 ? (gx < maximum.x ? gx : maximum.x) : 0.0f);
        const int cy = static_cast<int>(gy > 0 ? (gy < maximum.y ? gy : maximum.y) : 0.0f);
        const int cz = static_cast<int>(gz > 0 ? (gz < maximum.z ? gz : maximum.z) : 0.0f);
        const auto index = static_cast<std::uint32_t>((cz * ny + cy) * nx + cx);
        const bool same = within & (index == (place[i] & ~ShapeParticles::outside));
        const bool on = (flags[i] & (Voxel::active | Voxel::switchedOff)) == Voxel::active;
        const bool outside = place[i] >= ShapeParticles::outside;
        here[i] = within ? index : nowhere;
        // Neither flag is set for particles that stay outside: in no voxel, or in the same one, switched off.
        waits[i] = (same & on & outside) ? 1 : 0;
        changes[i] = (same ? !(on | outside) : (within | !outside)) ? 1 : 0;
        rx[i] = gx - static_cast<float>(cx) - 0.5f;
        ry[i] = gy - static_cast<float>(cy) - 0.5f;
        rz[i] = gz - static_cast<float>(cz) - 0.5f;
    }
}

/// Applies the forces as changes of velocity (see Force), then air and gravity, then the displacement of the step.
void move(ShapeParticles& particles, std::size_t first, std::size_t count, const KernelStep& step,
          const Scratch& scratch) {
    float* const __restrict x = particles.store.x.data() + first;
    float* const __restrict y = particles.store.y.data() + first;
    float* const __restrict z = particles.store.z.data() + first;
    float* const __restrict vx = particles.store.velocityX.data() + first;
    float* const __restrict vy = particles.store.velocityY.data() + first;
    float* const __restrict vz = particles.store.velocityZ.data() + first;
    const std::uint32_t* const __restrict place = particles.place.data() + first;
    const float *const __restrict fromX = scratch.rx.data(), *const __restrict fromY = scratch.ry.data(),
                            *const __restrict fromZ = scratch.rz.data();
    const float* const __restrict force = scratch.force.data();
    const std::uint32_t* const __restrict flags = scratch.flags.data();
    const glm::mat3 turn = step.pose.rotation;
    const glm::vec3 origin = step.pose.position, velocity = step.pose.velocity, spin = step.pose.angularVelocity;
    const glm::vec3 wind = step.wind, gravity = step.gravityStep;
    const float dt = step.seconds, metres = step.voxelMetres, growth = step.pose.growth;
    const float response = step.response, keeps = step.airKeeps;
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
        // No force applies outside. Multiply by 0 or 1 instead of selecting: a branch here prevents vectorisation.
        const std::uint32_t kind = (flags[i] >> Voxel::forceShift) | (place[i] & ShapeParticles::outside);
        const auto is = [kind](Force one) {
            return static_cast<float>(static_cast<int>(kind == static_cast<std::uint32_t>(one)));
        };
        const float isLinear = is(Force::linear), isOrbit = is(Force::orbit) + is(Force::gravity);
        const float isSpiral = is(Force::spiral), isHelix = is(Force::helix);
        const float isRotation = isSpiral + isHelix;

        const float wx = force[4 * i], wy = force[4 * i + 1], wz = force[4 * i + 2], k = force[4 * i + 3];
        const float rx = metres * fromX[i], ry = metres * fromY[i], rz = metres * fromZ[i];
        // t = ω × r, c = ω × t
        const float tx = wy * rz - wz * ry, ty = wz * rx - wx * rz, tz = wx * ry - wy * rx;
        const float cx = wy * tz - wz * ty, cy = wz * tx - wx * tz, cz = wx * ty - wy * tx;
        const float pull = isOrbit * (wx * wx + wy * wy + wz * wz);
        // acceleration a, and the velocity u that a rotation pulls to, in the shape's frame
        const float ax = isLinear * wx - pull * rx + isRotation * cx;
        const float ay = isLinear * wy - pull * ry + isRotation * cy;
        const float az = isLinear * wz - pull * rz + isRotation * cz;
        // Use the direction at the middle of the step, t + ½·dt·c; otherwise every circle would widen.
        const float along = isHelix * k, outwards = isSpiral * k - 0.5f * dt;
        const float ux = tx + along * wx - outwards * cx;
        const float uy = ty + along * wy - outwards * cy;
        const float uz = tz + along * wz - outwards * cz;

        // The shape's own velocity here; u is relative to it.
        const float ox = x[i] - origin.x, oy = y[i] - origin.y, oz = z[i] - origin.z;
        const float sx = velocity.x + spin.y * oz - spin.z * oy + growth * ox;
        const float sy = velocity.y + spin.z * ox - spin.x * oz + growth * oy;
        const float sz = velocity.z + spin.x * oy - spin.y * ox + growth * oz;
        const float drawn = isRotation * response;
        float nx = vx[i] + dt * (turn[0][0] * ax + turn[1][0] * ay + turn[2][0] * az);
        float ny = vy[i] + dt * (turn[0][1] * ax + turn[1][1] * ay + turn[2][1] * az);
        float nz = vz[i] + dt * (turn[0][2] * ax + turn[1][2] * ay + turn[2][2] * az);
        nx += drawn * (sx + turn[0][0] * ux + turn[1][0] * uy + turn[2][0] * uz - nx);
        ny += drawn * (sy + turn[0][1] * ux + turn[1][1] * uy + turn[2][1] * uz - ny);
        nz += drawn * (sz + turn[0][2] * ux + turn[1][2] * uy + turn[2][2] * uz - nz);

        nx = wind.x + keeps * (nx - wind.x) + gravity.x;
        ny = wind.y + keeps * (ny - wind.y) + gravity.y;
        nz = wind.z + keeps * (nz - wind.z) + gravity.z;
        vx[i] = nx;
        vy[i] = ny;
        vz[i] = nz;
        x[i] += dt * nx;
        y[i] += dt * ny;
        z[i] += dt * nz;
    }
}

/// Interpolates linearly in time: each step covers the share dt / (time left) of the remaining difference. Inside a
/// voxel the target is its look, within its interpolation time; outside, the fading look of the last voxel, within its
/// lifetime.
void changeLooks(ShapeParticles& particles, std::size_t first, std::size_t count, const Scratch& scratch, float dt,
                 std::uint8_t* __restrict dead) {
    particles::ParticleStore& store = particles.store;
    float* const __restrict red = store.red.data() + first;
    float* const __restrict green = store.green.data() + first;
    float* const __restrict blue = store.blue.data() + first;
    float* const __restrict opacity = store.opacity.data() + first;
    float* const __restrict radius = store.radius.data() + first;
    float* const __restrict age = store.age.data() + first;
    float* const __restrict lifetime = store.lifetime.data() + first;
    float* const __restrict settling = particles.settlingSeconds.data() + first;
    float* const __restrict picture = particles.picture.data() + first;
    float* const __restrict pictureSpeed = particles.pictureSpeed.data() + first;
    const std::uint32_t* const __restrict place = particles.place.data() + first;
    const std::uint32_t* const __restrict colours = scratch.colours.data();
    const std::uint32_t* const __restrict looks = scratch.looks.data();
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
        const int out = static_cast<int>(place[i] >> 31);
        const bool in = out == 0;
        const float life = std::bit_cast<float>(looks[4 * i + 2]);
        const float left = in ? settling[i] : life - age[i];
        const float share = left > dt ? dt / left : 1.0f;

        // Select by bit mask: for a choice between two loads the compiler emits a branch.
        const auto chosen = [bits = 0u - static_cast<std::uint32_t>(out)](std::uint32_t inside, std::uint32_t outside) {
            return inside ^ ((inside ^ outside) & bits);
        };
        const std::uint32_t redGreen = chosen(colours[4 * i], colours[4 * i + 2]);
        const std::uint32_t blueOpacity = chosen(colours[4 * i + 1], colours[4 * i + 3]);
        const auto size = std::bit_cast<float>(chosen(looks[4 * i], looks[4 * i + 1]));
        constexpr float unit = 1.0f / 65535;
        const auto channel = [](std::uint32_t value) { return unit * static_cast<float>(static_cast<int>(value)); };
        red[i] += share * (channel(redGreen & 0xffffu) - red[i]);
        green[i] += share * (channel(redGreen >> 16) - green[i]);
        blue[i] += share * (channel(blueOpacity & 0xffffu) - blue[i]);
        opacity[i] += share * (channel(blueOpacity >> 16) - opacity[i]);
        radius[i] += share * (size - radius[i]);
        const float speed =
            pictureSpeed[i] + (in ? share : 0.0f) * (std::bit_cast<float>(looks[4 * i + 3]) - pictureSpeed[i]);
        pictureSpeed[i] = speed;
        picture[i] += dt * speed;

        const float rest = settling[i] - dt;
        settling[i] = in ? (rest > 0 ? rest : 0.0f) : settling[i];
        const float older = age[i] + dt;
        age[i] = in ? 0.0f : older;
        lifetime[i] = life;
        dead[i] = static_cast<std::uint8_t>(out & (older >= life ? 1 : 0));
    }
}

/// Moves the few particles that change their voxel in a step. Their motion and look of this step still came from the
/// old voxel.
void changePlaces(ShapeParticles& particles, std::size_t first, std::size_t count, std::span<Voxel> voxels,
                  const Scratch& scratch, const std::uint8_t* dead, std::uint8_t* arriving) {
    std::uint32_t* const place = particles.place.data() + first;
    for (std::size_t i = 0; i < count; ++i) arriving[i] = scratch.waits[i] & (dead[i] ^ 1);
    particles::forEachFlagged(scratch.changes.data(), count, [&](std::size_t i) {
        const std::uint32_t now = scratch.here[i], before = place[i];
        const bool isOn = now != nowhere && voxels[now].isOn();
        if ((before & ShapeParticles::outside) == 0)
            std::atomic_ref(voxels[before].density).fetch_sub(1, std::memory_order_relaxed);
        place[i] = (isOn ? now : before) | ShapeParticles::outside;
        arriving[i] = isOn && dead[i] == 0 ? 1 : 0;
    });
}

}  // namespace

KernelStep::KernelStep(const VoxelGrid& grid, const Pose& where, const Motion& motion, float stepSeconds)
    : counts(grid.lattice().counts),
      voxelMetres(grid.lattice().edgeMetres * where.scale),
      pose(where),
      seconds(stepSeconds),
      response(1 - std::exp(-motion.responsePerSecond * stepSeconds)),
      airKeeps(std::exp(-motion.airDragPerSecond * stepSeconds)),
      wind(motion.wind),
      gravityStep(motion.gravity * stepSeconds) {
    toVoxels = glm::transpose(where.rotation) / voxelMetres;
    offset = -(toVoxels * where.position) - grid.lattice().origin / grid.lattice().edgeMetres;
}

void updateParticles(ShapeParticles& particles, std::size_t first, std::size_t count, VoxelGrid& grid,
                     const KernelStep& step, std::uint8_t* dead, std::uint8_t* arriving) {
    const std::span<Voxel> voxels = grid.voxels();
    const std::size_t end = first + count;
    for (std::size_t done = 0; done < count; done += runSize) {
        Scratch scratch;
        const std::size_t from = first + done, here = std::min(runSize, count - done);
        copyVoxels(particles, from, here, end, voxels.data(), scratch);
        lookUp(particles, from, here, step, scratch);
        move(particles, from, here, step, scratch);
        changeLooks(particles, from, here, scratch, step.seconds, dead + done);
        changePlaces(particles, from, here, voxels, scratch, dead + done, arriving + done);
    }
}

void dropWhereFull(const ShapeParticles& particles, std::size_t first, std::size_t count, std::span<const Voxel> voxels,
                   std::uint8_t* arriving) {
    const std::uint32_t* const place = particles.place.data() + first;
    particles::forEachFlagged(arriving, count, [&](std::size_t i) {
        const Voxel& voxel = voxels[place[i] & ~ShapeParticles::outside];
        arriving[i] = voxel.density < voxel.maximumDensity ? 1 : 0;
    });
}

void admit(ShapeParticles& particles, std::span<const std::uint32_t> arrivals, std::span<std::uint32_t> targets,
           std::span<Voxel> voxels, bool fullRefuse) {
    parallel::forEachBlock(arrivals.size(), arrivalsInABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k)
            targets[k] = particles.place[arrivals[k]] & ~ShapeParticles::outside;
    });
    // Arrivals at the same voxel must be admitted in order, so each thread handles all arrivals at a range of voxels.
    const std::size_t parts = arrivals.size() < arrivalsInABlock ? 1 : partsOfVoxels;
    const std::size_t part = (voxels.size() + parts - 1) / parts;
    parallel::forEachBlock(voxels.size(), part, [&](std::size_t firstVoxel, std::size_t count) {
        constexpr std::size_t ahead = 12;
        for (std::size_t k = 0; k < targets.size(); ++k) {
            if (k + ahead < targets.size() && targets[k + ahead] - firstVoxel < count) {
                __builtin_prefetch(&voxels[targets[k + ahead]].density, 1);
                __builtin_prefetch(&particles.settlingSeconds[arrivals[k + ahead]], 1);
                __builtin_prefetch(&particles.store.age[arrivals[k + ahead]], 1);
            }
            if (targets[k] - firstVoxel >= count) continue;
            const std::uint32_t i = arrivals[k];
            Voxel& voxel = voxels[targets[k]];
            if (fullRefuse && voxel.density >= voxel.maximumDensity) continue;
            ++voxel.density;
            particles.place[i] = targets[k];
            particles.settlingSeconds[i] = voxel.interpolationSeconds;
            particles.store.age[i] = 0;
        }
    });
}

}  // namespace dustbench::voxel_shape
