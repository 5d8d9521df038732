#include "methods/voxel_shape/collision/shape_collision.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {
namespace {

constexpr float gapMetres = 1e-3f;
constexpr std::uint32_t scatterStream = 8;

/// Returns a vector in the surface, uniform on the unit disc; the same for a particle at every hit.
glm::vec3 alongSurface(const glm::vec3& normal, std::uint64_t serial) {
    const auto toss = maths::uniform4(0, scatterStream, serial);
    const glm::vec2 point = maths::discPoint(toss[0], toss[1]);
    const maths::Tangents tangents = maths::tangentsOf(normal);
    return point.x * tangents.first + point.y * tangents.second;
}

/// The velocity relative to the surface after a hit.
glm::vec3 rebound(const glm::vec3& velocity, const glm::vec3& normal, const Impact& impact, std::uint64_t serial) {
    const float into = std::min(glm::dot(velocity, normal), 0.0f);
    const glm::vec3 along = velocity - into * normal;
    return (1 - impact.friction) * along - impact.restitution * into * normal +
           impact.scatter * into * alongSurface(normal, serial);
}

/// The place at the step's end of a particle that hit a surface at `share` of its path: in front of the point that it
/// hit, by a gap along the path relative to the surface, which is free up to the hit.
glm::vec3 stopOn(const particles::Touch& touch, const glm::vec3& relativeVelocity, float share, float stepSeconds) {
    const glm::vec3 carried = touch.point + (1 - share) * stepSeconds * touch.velocity;
    const float speed = glm::length(relativeVelocity);
    if (!(speed > 0)) return carried;
    return carried - std::min(share * stepSeconds, gapMetres / speed) * relativeVelocity;
}

}  // namespace

ShapeCollision::ShapeCollision(const scene::Scene& scene, float voxelMetres, const Impact& impact,
                               const Collidable& with)
    : scene_(&scene),
      impact_(impact),
      surface_({.ground = false, .solids = with.solids, .vehicle = with.vehicle}),
      places_(scene, voxelMetres, with) {}

void ShapeCollision::moveTo(const scene::SceneState& state, double stepSeconds) {
    if (places_.empty()) return;
    surface_.begin(
        {.scene = *scene_, .state = state, .seconds = stepSeconds, .seed = 0, .fixedRatePerSecond = 0, .wheels = {}});
    places_.moveTo(*scene_, state, stepSeconds);
}

void ShapeCollision::switchVoxels(VoxelGrid& grid, const Pose& pose) {
    const Lattice& lattice = grid.lattice();
    AxisBox local, box;
    local.take(lattice.origin);
    local.take(lattice.maximumCorner());
    local.forEachCorner([&](const glm::vec3& corner) { box.take(pose.toWorld(corner)); });
    const std::vector<std::uint32_t> close = places_.meeting(box, false);
    if (close.empty() && off_ == 0) return;
    places_.refresh(box);
    std::atomic<std::size_t> off{0};
    const std::span<const std::uint32_t> active = grid.active();
    const std::span<Voxel> voxels = grid.voxels();
    parallel::forEachBlock(active.size(), 1024, [&](std::size_t first, std::size_t count) {
        std::size_t found = 0;
        for (std::size_t k = first; k < first + count; ++k) {
            const glm::vec3 centre = pose.toWorld(lattice.centre(lattice.cell(active[k])));
            const bool touches = places_.nearAny(close, centre);
            voxels[active[k]].setSwitchedOff(touches);
            found += touches;
        }
        off += found;
    });
    off_ = off;
}

std::size_t ShapeCollision::stopParticles(ShapeParticles& particles, float stepSeconds) const {
    if (places_.empty()) return 0;
    particles::ParticleStore& s = particles.store;
    std::atomic<std::size_t> hits{0};
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        AxisBox box;
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::vec3 now = s.position(i);
            box.take(now);
            box.take(now - stepSeconds * glm::vec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]));
        }
        const std::vector<std::uint32_t> close = places_.meeting(box, true);
        if (close.empty()) return;
        std::size_t found = 0;
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::vec3 velocity(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
            const glm::vec3 now = s.position(i), before = now - stepSeconds * velocity;
            if (!places_.mayHit(close, now, stepSeconds * glm::length(velocity))) continue;
            float share = particles::Surface::none;
            surface_.meet({1, &before.x, &before.y, &before.z, &now.x, &now.y, &now.z, &stepSeconds}, &share);
            if (share > 1) continue;
            ++found;
            const particles::Touch touch = surface_.touchAt({before, now, stepSeconds, share});
            const glm::vec3 relative = velocity - touch.velocity;
            const glm::vec3 stop = stopOn(touch, relative, share, stepSeconds);
            const glm::vec3 after = touch.velocity + rebound(relative, touch.normal, impact_, s.serial[i]);
            s.x[i] = stop.x;
            s.y[i] = stop.y;
            s.z[i] = stop.z;
            s.velocityX[i] = after.x;
            s.velocityY[i] = after.y;
            s.velocityZ[i] = after.z;
        }
        hits += found;
    });
    return hits;
}

MemoryReport ShapeCollision::memory() const {
    return {{"solids: triangles", surface_.bytes(), 0}, {"solids: cells", places_.bytes(), 0}};
}

}  // namespace dustbench::voxel_shape
