#include "methods/kit/particles/chunk_update.h"

#include <algorithm>

namespace dustbench::particles {
namespace {

void growOlder(std::size_t count, float* __restrict age, float seconds) {
    for (std::size_t i = 0; i < count; ++i) age[i] += seconds;
}

void shareOfLife(std::size_t count, const float* __restrict age, const float* __restrict lifetime,
                 float* __restrict share) {
    for (std::size_t i = 0; i < count; ++i) {
        const float lived = age[i] / lifetime[i];
        share[i] = lived < 1.0f ? lived : 1.0f;
    }
}

/// v ← v + a·dt, then x ← x + v·dt. Source: Thesis, 5.1. Departs: the printed a = mass·ΣF is ΣF/mass; the mass is 1.
void integrate(std::size_t count, float* __restrict position, float* __restrict velocity,
               const float* __restrict acceleration, float seconds) {
    for (std::size_t i = 0; i < count; ++i) {
        const float v = velocity[i] + acceleration[i] * seconds;
        velocity[i] = v;
        position[i] += v * seconds;
    }
}

void drift(std::size_t count, float* __restrict position, const float* __restrict velocity,
           const float* __restrict seconds) {
    for (std::size_t i = 0; i < count; ++i) position[i] += velocity[i] * seconds[i];
}

void light(std::size_t count, float* __restrict colour, const float* __restrict luminosity) {
    for (std::size_t i = 0; i < count; ++i) colour[i] *= luminosity[i];
}

void clear(std::size_t count, std::initializer_list<float*> columns) {
    for (float* column : columns) std::fill_n(column, count, 0.0f);
}

void shade(Chunk& chunk, const PartList& parts, const Step& step) {
    clear(chunk.count, {chunk.luminosityRed, chunk.luminosityGreen, chunk.luminosityBlue});
    for (const auto& part : parts.shadings()) part->shade(chunk, step);
    light(chunk.count, chunk.red, chunk.luminosityRed);
    light(chunk.count, chunk.green, chunk.luminosityGreen);
    light(chunk.count, chunk.blue, chunk.luminosityBlue);
}

void move(Chunk& chunk, float seconds) {
    integrate(chunk.count, chunk.x, chunk.velocityX, chunk.accelerationX, seconds);
    integrate(chunk.count, chunk.y, chunk.velocityY, chunk.accelerationY, seconds);
    integrate(chunk.count, chunk.z, chunk.velocityZ, chunk.accelerationZ, seconds);
}

void drift(Chunk& chunk) {
    drift(chunk.count, chunk.x, chunk.velocityX, chunk.age);
    drift(chunk.count, chunk.y, chunk.velocityY, chunk.age);
    drift(chunk.count, chunk.z, chunk.velocityZ, chunk.age);
}

[[gnu::noinline]] void moveAmong(const MetSurfaces& surfaces, Chunk& chunk, float seconds) {
    WayBegins begins;
    begins.take(chunk, &seconds, false);
    move(chunk, seconds);
    meetSurfaces(chunk, begins, surfaces);
}

[[gnu::noinline]] void driftAmong(const MetSurfaces& surfaces, Chunk& chunk) {
    WayBegins begins;
    begins.take(chunk, chunk.age, true);
    drift(chunk);
    std::fill_n(chunk.dead, chunk.count, std::uint8_t{0});
    meetSurfaces(chunk, begins, surfaces);
    for (std::size_t i = 0; i < chunk.count; ++i)
        if (chunk.dead[i]) chunk.lifetime[i] = chunk.age[i];  // dies in the next step
}

/// Everything before the integration.
void drive(Chunk& chunk, const PartList& parts, const Step& step) {
    const std::size_t count = chunk.count;
    clear(count, {chunk.accelerationX, chunk.accelerationY, chunk.accelerationZ, chunk.airX, chunk.airY, chunk.airZ});

    growOlder(count, chunk.age, static_cast<float>(step.seconds));
    shareOfLife(count, chunk.age, chunk.lifetime, chunk.share);

    std::fill_n(chunk.dead, count, std::uint8_t{0});
    for (const auto& part : parts.lives()) part->evaluate(chunk, step);

    if (parts.shadings().empty()) {
        parts.colour()->update(chunk, step);
    } else {
        parts.colour()->initialise(chunk, step);  // the colour still contains the last step's shading
        shade(chunk, parts, step);
    }
    parts.size()->update(chunk, step);

    for (const auto& part : parts.forces()) part->blow(chunk, step);
    for (const auto& part : parts.forces()) part->push(chunk, step);
}

}  // namespace

Newborns NewbornBlock::newborns(std::size_t first, std::size_t count, std::uint64_t serial, const Births& births,
                                std::span<const Emitter> emitters, double stepSeconds) {
    Chunk chunk;
    chunk.count = count;
    chunk.serial = serial_.data();
    std::size_t next = 0;
    for (float** column :
         {&chunk.x, &chunk.y, &chunk.z, &chunk.velocityX, &chunk.velocityY, &chunk.velocityZ, &chunk.age,
          &chunk.lifetime, &chunk.radius, &chunk.opacity, &chunk.red, &chunk.green, &chunk.blue})
        *column = columns_[next++].data();
    std::size_t turn = serial % emitters.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double at = births.firstSeconds + static_cast<double>(first + i) * births.spacingSeconds;
        const double born = std::clamp(at, 0.0, stepSeconds);  // rounding may put the last birth slightly after the end
        serial_[i] = serial + i;
        emitter_[i] = &emitters[turn];
        turn = turn + 1 < emitters.size() ? turn + 1 : 0;
        moment_[i] = static_cast<float>(born / stepSeconds);
        chunk.age[i] = static_cast<float>(stepSeconds - born);
    }
    return {chunk, moment_.data(), emitter_.data()};
}

void ChunkScratch::lend(Chunk& chunk, bool shaded) {
    std::size_t next = 0;
    for (float** column : {&chunk.share, &chunk.accelerationX, &chunk.accelerationY, &chunk.accelerationZ, &chunk.airX,
                           &chunk.airY, &chunk.airZ})
        *column = values[next++].data();
    if (shaded)
        for (float** column : {&chunk.luminosityRed, &chunk.luminosityGreen, &chunk.luminosityBlue})
            *column = values[next++].data();
    chunk.dead = dead.data();
}

void updateChunk(Chunk& chunk, const PartList& parts, const MetSurfaces& surfaces, const Step& step) {
    drive(chunk, parts, step);
    const float seconds = static_cast<float>(step.seconds);
    if (surfaces.empty())
        move(chunk, seconds);
    else
        moveAmong(surfaces, chunk, seconds);
    for (const auto& part : parts.forces()) part->touch(chunk, step);
}

void advanceChunk(Chunk& chunk, const PartList& parts, const Step& step) {
    drive(chunk, parts, step);
    move(chunk, static_cast<float>(step.seconds));
}

void initialiseNewborns(Newborns& newborns, const PartList& parts, const MetSurfaces& surfaces, const Step& step) {
    Chunk& chunk = newborns.chunk;
    parts.position()->place(newborns, step);
    parts.velocity()->launch(newborns, step);
    for (std::size_t i = 0; i < chunk.count; ++i)
        if (const glm::vec3& thrown = newborns.emitter[i]->thrown; thrown != glm::vec3(0))
            newborns.setVelocity(i, thrown + glm::vec3(chunk.velocityX[i], chunk.velocityY[i], chunk.velocityZ[i]));
    parts.lifetime().giveLifetimes(newborns, step);
    if (surfaces.empty())
        drift(chunk);
    else
        driftAmong(surfaces, chunk);

    shareOfLife(chunk.count, chunk.age, chunk.lifetime, chunk.share);
    parts.colour()->initialise(chunk, step);
    if (!parts.shadings().empty()) shade(chunk, parts, step);
    parts.size()->initialise(chunk, step);
    for (const auto& part : parts.forces()) part->touch(chunk, step);
}

}  // namespace dustbench::particles
