#include "methods/kit/particles/position_step.h"

#include <array>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/contacts.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::particles {
namespace {

constexpr std::size_t pointBlock = 2048;

template <typename Work>
void forEachPoint(std::size_t points, const Work& work) {
    parallel::forEachBlock(points, pointBlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) work(i);
    });
}

}  // namespace

/// The acceleration of all other forces: a = (v₁ − v₀)/Δt.
void PositionStep::begin(const SpringNumbers& numbers, const LatticeLinks& links, const StepStart& start,
                         double stepSeconds, const ParticleStore& store) {
    points_.resize(store.size());
    forEachPoint(store.size(), [&](std::size_t i) {
        const glm::dvec3 before(start.velocityX[i], start.velocityY[i], start.velocityZ[i]);
        const glm::dvec3 after(store.velocityX[i], store.velocityY[i], store.velocityZ[i]);
        const glm::dvec3 x(start.x[i], start.y[i], start.z[i]);
        points_[i] = {x, x, before, (after - before) / stepSeconds, 1 / numbers.massKg};
    });
    for (const std::uint32_t i : links.pinned()) points_[i].inverseMass = 0;
}

/// Contacts on the paths of a substep. Only particles with a contact get its position and velocity: others keep theirs,
/// which are not rounded.
void PositionStep::meet(const MetSurfaces& surfaces, double h, float leftSeconds, ParticleStore& store,
                        const Fates& fates) {
    parallel::forEachBlock(points_.size(), chunkSize, [&](std::size_t first, std::size_t count) {
        WayBegins begins;
        std::array<std::array<float, chunkSize>, 6> moved;
        Chunk chunk;
        chunk.count = count;
        chunk.age = &store.age[first];
        chunk.lifetime = &store.lifetime[first];
        chunk.serial = &store.serial[first];
        chunk.dead = &fates.dead[first];
        if (!fates.hits.empty()) chunk.hits = &fates.hits[first / chunkSize];
        std::size_t next = 0;
        for (float** column : {&chunk.x, &chunk.y, &chunk.z, &chunk.velocityX, &chunk.velocityY, &chunk.velocityZ})
            *column = moved[next++].data();
        for (std::size_t i = 0; i < count; ++i) {
            const Point& p = points_[first + i];
            const glm::vec3 from(p.before), to(p.x), v(p.velocity);
            begins.x[i] = from.x, begins.y[i] = from.y, begins.z[i] = from.z;
            begins.seconds[i] = static_cast<float>(h);
            chunk.x[i] = to.x, chunk.y[i] = to.y, chunk.z[i] = to.z;
            chunk.velocityX[i] = v.x, chunk.velocityY[i] = v.y, chunk.velocityZ[i] = v.z;
        }
        meetSurfaces(chunk, begins, surfaces, leftSeconds);
        for (std::size_t i = 0; i < count; ++i) {
            Point& p = points_[first + i];
            const glm::vec3 to(chunk.x[i], chunk.y[i], chunk.z[i]);
            if (p.inverseMass == 0 || to == glm::vec3(p.x)) continue;
            p.x = to;
            p.velocity = glm::vec3(chunk.velocityX[i], chunk.velocityY[i], chunk.velocityZ[i]);
        }
    });
}

void PositionStep::run(const SpringNumbers& numbers, const Linked& linked, const Way& way, ParticleStore& store,
                       const Fates& fates) {
    const LatticeLinks& links = linked.links;
    const MetSurfaces perSubstep = way.surfaces.perPartOf(numbers.substeps);
    begin(numbers, links, way.start, way.stepSeconds, store);
    const double h = way.stepSeconds / numbers.substeps;
    const double gamma = numbers.damping / (numbers.stiffness * h);
    const auto solve = [&](const Link& link) {
        Point &a = points_[link.a], &b = points_[link.b];
        const double inverseMass = a.inverseMass + b.inverseMass;
        const glm::dvec3 across = a.x - b.x;
        const double length = glm::length(across);
        if (inverseMass == 0 || length == 0) return;
        const glm::dvec3 gradient = across / length;
        const double stretch = length - static_cast<double>(link.restMetres);
        const double moved = glm::dot(gradient, (a.x - a.before) - (b.x - b.before));
        const double compliance = 1 / (numbers.stiffness * static_cast<double>(link.share) * h * h);
        const double lambda = -(stretch + gamma * moved) / ((1 + gamma) * inverseMass + compliance);
        a.x += a.inverseMass * lambda * gradient;
        b.x -= b.inverseMass * lambda * gradient;
    };
    for (int substep = 1; substep <= numbers.substeps; ++substep) {
        forEachPoint(points_.size(), [&](std::size_t i) {
            Point& p = points_[i];
            p.before = p.x;
            p.velocity += h * p.acceleration;
            if (p.inverseMass > 0) p.x += h * p.velocity;
        });
        const auto left = static_cast<float>((numbers.substeps - substep) * h);
        for (const std::uint32_t i : links.pinned())
            points_[i].x = linked.frame.toWorld(glm::vec3(linked.lattice.restOf(store.serial[i])), left);
        links.forEach(solve);
        forEachPoint(points_.size(),
                     [&](std::size_t i) { points_[i].velocity = (points_[i].x - points_[i].before) / h; });
        if (!perSubstep.empty()) meet(perSubstep, h, left, store, fates);
    }
    forEachPoint(points_.size(), [&](std::size_t i) {
        const glm::vec3 x(points_[i].x), v(points_[i].velocity);
        store.x[i] = x.x, store.y[i] = x.y, store.z[i] = x.z;
        store.velocityX[i] = v.x, store.velocityY[i] = v.y, store.velocityZ[i] = v.z;
    });
}

}  // namespace dustbench::particles
