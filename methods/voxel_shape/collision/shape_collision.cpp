#include "methods/voxel_shape/collision/shape_collision.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"
#include "methods/voxel_shape/collision/mesh_parts.h"

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

template <typename Visit>
void forEachCorner(const glm::vec3& minimum, const glm::vec3& maximum, const Visit& visit) {
    for (int corner = 0; corner < 8; ++corner)
        visit(glm::vec3(corner & 1 ? maximum.x : minimum.x, corner & 2 ? maximum.y : minimum.y,
                        corner & 4 ? maximum.z : minimum.z));
}

}  // namespace

ShapeCollision::Place ShapeCollision::placeOf(Nearness nearness, const glm::mat4& toWorld) {
    const Lattice& lattice = nearness.lattice();
    const glm::mat4 toSolid = glm::inverse(toWorld);
    Box box{glm::vec3(INFINITY), glm::vec3(-INFINITY)};
    forEachCorner(lattice.origin, lattice.maximumCorner(), [&](const glm::vec3& corner) {
        const glm::vec3 world(toWorld * glm::vec4(corner, 1));
        box.minimum = glm::min(box.minimum, world);
        box.maximum = glm::max(box.maximum, world);
    });
    const glm::mat3 toCells = glm::mat3(toSolid) / lattice.edgeMetres;
    const glm::vec3 offset = (glm::vec3(toSolid[3]) - lattice.origin) / lattice.edgeMetres;
    return {std::move(nearness), toCells, offset, box};
}

ShapeCollision::ShapeCollision(const scene::Scene& scene, float voxelMetres, const Impact& impact)
    : impact_(impact), reachMetres_(voxelMetres * std::sqrt(3.0f) / 2) {
    std::vector<std::pair<scene::Mesh, glm::mat4>> parts;
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        tree_.add(*scene.solids[i].mesh, scene.solidPoses[i].toWorld);
        for (scene::Mesh& part : partsOf(*scene.solids[i].mesh))
            parts.emplace_back(std::move(part), scene.solidPoses[i].toWorld);
    }
    std::vector<std::optional<Place>> places(parts.size());
    parallel::forEachBlock(parts.size(), 1, [&](std::size_t i, std::size_t) {
        const auto& [mesh, toWorld] = parts[i];
        const float scale = glm::length(glm::vec3(toWorld[0]));
        places[i] = placeOf(Nearness(mesh, voxelMetres / 2 / scale, reachMetres_ / scale), toWorld);
    });
    for (std::optional<Place>& place : places) places_.push_back(std::move(*place));
    tree_.build();
}

std::vector<std::uint32_t> ShapeCollision::placesMeeting(const Box& box) const {
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < places_.size(); ++i)
        if (places_[i].box.meets(box)) list.push_back(i);
    return list;
}

bool ShapeCollision::nearAny(const std::vector<std::uint32_t>& places, const glm::vec3& point) const {
    return std::any_of(places.begin(), places.end(), [&](std::uint32_t i) {
        return places_[i].nearness.at(places_[i].toCells * point + places_[i].offset);
    });
}

void ShapeCollision::switchVoxels(VoxelGrid& grid, const Pose& pose) {
    const Lattice& lattice = grid.lattice();
    Box box{glm::vec3(INFINITY), glm::vec3(-INFINITY)};
    forEachCorner(lattice.origin, lattice.maximumCorner(), [&](const glm::vec3& corner) {
        const glm::vec3 world = pose.toWorld(corner);
        box.minimum = glm::min(box.minimum, world);
        box.maximum = glm::max(box.maximum, world);
    });
    const std::vector<std::uint32_t> close = placesMeeting(box);
    if (close.empty() && off_ == 0) return;
    std::atomic<std::size_t> off{0};
    const std::span<const std::uint32_t> active = grid.active();
    const std::span<Voxel> voxels = grid.voxels();
    parallel::forEachBlock(active.size(), 1024, [&](std::size_t first, std::size_t count) {
        std::size_t found = 0;
        for (std::size_t k = first; k < first + count; ++k) {
            const glm::vec3 centre = pose.toWorld(lattice.centre(lattice.cell(active[k])));
            const bool touches = nearAny(close, centre);
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
        Box box{glm::vec3(INFINITY), glm::vec3(-INFINITY)};
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::vec3 now = s.position(i);
            const glm::vec3 before = now - stepSeconds * glm::vec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
            box.minimum = glm::min(box.minimum, glm::min(now, before));
            box.maximum = glm::max(box.maximum, glm::max(now, before));
        }
        const std::vector<std::uint32_t> close = placesMeeting(box);
        if (close.empty()) return;
        std::size_t found = 0;
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::vec3 velocity(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
            const glm::vec3 now = s.position(i), way = stepSeconds * velocity, before = now - way;
            const float length = glm::length(way);
            // A path shorter than the reach that begins away from all solids cannot hit one.
            if (!(length > 0) || (length <= reachMetres_ && !nearAny(close, before))) continue;
            const auto hit = tree_.firstHit(before, now);
            if (!hit) continue;
            ++found;
            // Step back along the path, which is free up to the hit.
            const glm::vec3 stop = before + std::max(0.0f, hit->share - gapMetres / length) * way;
            const float into = glm::dot(velocity, hit->normal);
            const glm::vec3 along = velocity - into * hit->normal;
            const glm::vec3 after = (1 - impact_.friction) * along - impact_.restitution * into * hit->normal +
                                    impact_.scatter * into * alongSurface(hit->normal, s.serial[i]);
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
    std::size_t cells = places_.capacity() * sizeof(Place);
    for (const Place& place : places_) cells += place.nearness.bytes();
    return {{"solids: triangles", tree_.bytes(), 0}, {"solids: cells", cells, 0}};
}

}  // namespace dustbench::voxel_shape
