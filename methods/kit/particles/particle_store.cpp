#include "methods/kit/particles/particle_store.h"

#include <algorithm>
#include <span>

#include "methods/kit/maths/hash.h"

namespace dustbench::particles {

ParticleStore::ParticleStore(MemoryLedger& ledger)
    : serial(ledger.account("particle serials")),
      x(ledger.account("particle positions")),
      y(ledger.account("particle positions")),
      z(ledger.account("particle positions")),
      velocityX(ledger.account("particle velocities")),
      velocityY(ledger.account("particle velocities")),
      velocityZ(ledger.account("particle velocities")),
      age(ledger.account("particle ages")),
      lifetime(ledger.account("particle ages")),
      radius(ledger.account("particle sizes")),
      opacity(ledger.account("particle colours")),
      red(ledger.account("particle colours")),
      green(ledger.account("particle colours")),
      blue(ledger.account("particle colours")) {}

template <typename Action>
void ParticleStore::forEachColumn(Action action) {
    action(serial);
    for (auto* column : {&x, &y, &z, &velocityX, &velocityY, &velocityZ, &age, &lifetime, &radius, &opacity})
        action(*column);
    if (!uniformColour)
        for (auto* column : {&red, &green, &blue}) action(*column);
}

void ParticleStore::reserve(std::size_t count) {
    forEachColumn([count](auto& column) { column.reserve(count); });
}

void ParticleStore::resize(std::size_t count) {
    if (count > serial.capacity()) reserve(std::max(count, serial.capacity() + serial.capacity() / 4));
    forEachColumn([count](auto& column) { column.resize(count); });
}

void ParticleStore::move(std::size_t from, std::size_t to) {
    forEachColumn([from, to](auto& column) { column[to] = column[from]; });
}

ParticleStore::operator Puffs() const {
    return {.serial = serial,
            .x = x,
            .y = y,
            .z = z,
            .velocityX = velocityX,
            .velocityY = velocityY,
            .velocityZ = velocityZ,
            .age = age,
            .lifetime = lifetime,
            .radius = radius,
            .opacity = opacity,
            .red = red,
            .green = green,
            .blue = blue,
            .uniformColour = uniformColour,
            .colourOfAll = colourOfAll};
}

Chunk ParticleStore::chunk(std::size_t first, std::size_t count) {
    Chunk chunk;
    chunk.first = first;
    chunk.count = count;
    chunk.serial = serial.data() + first;
    chunk.x = x.data() + first;
    chunk.y = y.data() + first;
    chunk.z = z.data() + first;
    chunk.velocityX = velocityX.data() + first;
    chunk.velocityY = velocityY.data() + first;
    chunk.velocityZ = velocityZ.data() + first;
    chunk.age = age.data() + first;
    chunk.lifetime = lifetime.data() + first;
    chunk.radius = radius.data() + first;
    chunk.opacity = opacity.data() + first;
    if (!uniformColour) {
        chunk.red = red.data() + first;
        chunk.green = green.data() + first;
        chunk.blue = blue.data() + first;
    }
    return chunk;
}

void ParticleStore::put(const Chunk& chunk, std::size_t from, std::size_t to) {
    serial[to] = chunk.serial[from];
    x[to] = chunk.x[from];
    y[to] = chunk.y[from];
    z[to] = chunk.z[from];
    velocityX[to] = chunk.velocityX[from];
    velocityY[to] = chunk.velocityY[from];
    velocityZ[to] = chunk.velocityZ[from];
    age[to] = chunk.age[from];
    lifetime[to] = chunk.lifetime[from];
    radius[to] = chunk.radius[from];
    opacity[to] = chunk.opacity[from];
    if (!uniformColour) {
        red[to] = chunk.red[from];
        green[to] = chunk.green[from];
        blue[to] = chunk.blue[from];
    }
}

void ParticleStore::append(const Puffs& puffs) {
    const std::size_t before = size();
    if (before == 0) {
        keepOneColour(puffs.uniformColour);
        colourOfAll = puffs.colourOfAll;
    } else if (!puffs.uniformColour || puffs.colourOfAll != colourOfAll) {
        keepOneColour(false);
    }
    resize(before + puffs.size());
    const auto take = [before](auto& column, const auto& from) {
        std::ranges::copy(from, column.begin() + static_cast<std::ptrdiff_t>(before));
    };
    take(serial, puffs.serial);
    take(x, puffs.x), take(y, puffs.y), take(z, puffs.z);
    take(velocityX, puffs.velocityX), take(velocityY, puffs.velocityY), take(velocityZ, puffs.velocityZ);
    take(age, puffs.age), take(lifetime, puffs.lifetime);
    take(radius, puffs.radius), take(opacity, puffs.opacity);
    if (uniformColour) return;
    for (std::size_t i = 0; i < puffs.size(); ++i) {
        const glm::vec3 colour = puffs.colour(i);
        red[before + i] = colour.r, green[before + i] = colour.g, blue[before + i] = colour.b;
    }
}

std::uint64_t ParticleStore::hash() const {
    maths::Hash hash;
    hash.add(static_cast<std::uint64_t>(size()));
    hash.add(std::span(serial.data(), serial.size()));
    for (const auto* column :
         {&x, &y, &z, &velocityX, &velocityY, &velocityZ, &age, &lifetime, &radius, &opacity, &red, &green, &blue})
        hash.add(std::span(column->data(), column->size()));
    for (int i = 0; i < 3; ++i) hash.add(colourOfAll[i]);
    return hash.value();
}

void ParticleStore::keepOneColour(bool oneForAll) {
    if (oneForAll == uniformColour) return;
    uniformColour = oneForAll;
    int channel = 0;
    for (auto* column : {&red, &green, &blue}) {
        column->clear();
        column->shrink_to_fit();
        if (!oneForAll) {
            column->reserve(serial.capacity());
            column->resize(size(), colourOfAll[channel]);
        }
        ++channel;
    }
}

}  // namespace dustbench::particles
