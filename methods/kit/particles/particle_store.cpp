#include "methods/kit/particles/particle_store.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "methods/kit/maths/hash.h"

namespace dustbench::particles {
namespace {

template <typename Store>
auto columnsOf(Store& s) {
    return std::array{s.x.data(),         s.y.data(),   s.z.data(),        s.velocityX.data(), s.velocityY.data(),
                      s.velocityZ.data(), s.age.data(), s.lifetime.data(), s.radius.data(),    s.opacity.data()};
}

/// Null for each colour of a store with one colour for all.
template <typename Store>
auto coloursOf(Store& s) {
    return std::array{s.red.data(), s.green.data(), s.blue.data()};
}

}  // namespace

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

struct LinkedParticles::Node {
    std::uint64_t serial;
    std::array<float, 10> values;  ///< in the order of `columnsOf`
    std::array<float, 3> colour;   ///< linear RGB
    Node* next;
};

LinkedParticles::LinkedParticles(MemoryLedger& ledger, bool pool)
    : account_(ledger.account("particle nodes")), pool_(pool) {}

LinkedParticles::~LinkedParticles() {
    for (Node* list : {first_, dead_})
        while (list) {
            account_.release(sizeof(Node));
            delete std::exchange(list, list->next);
        }
}

std::size_t LinkedParticles::bytesPerParticle() {
    return sizeof(Node);
}

/// A node of the pool, or a new one.
LinkedParticles::Node* LinkedParticles::take() {
    if (dead_) return std::exchange(dead_, dead_->next);
    account_.book(sizeof(Node));
    ++allocations_;
    return new Node;
}

void LinkedParticles::bury(const ParticleStore& store, std::span<const std::uint32_t> dead) {
    const auto columns = columnsOf(store);
    const auto colours = coloursOf(store);
    auto next = dead.begin();
    std::size_t i = 0;
    Node** link = &first_;
    for (; *link; ++i) {
        Node* const node = *link;
        if (next != dead.end() && *next == i) {
            ++next;
            *link = node->next;
            --size_;
            if (pool_) {
                node->next = std::exchange(dead_, node);
            } else {
                account_.release(sizeof(Node));
                delete node;
            }
            continue;
        }
        for (std::size_t c = 0; c < columns.size(); ++c) node->values[c] = columns[c][i];
        if (!store.uniformColour)
            for (std::size_t c = 0; c < colours.size(); ++c) node->colour[c] = colours[c][i];
        link = &node->next;
    }
    end_ = link;
}

void LinkedParticles::add(const ParticleStore& store, std::size_t first) {
    const auto columns = columnsOf(store);
    for (std::size_t i = first; i < store.size(); ++i) {
        Node* const node = take();
        node->serial = store.serial[i];
        for (std::size_t c = 0; c < columns.size(); ++c) node->values[c] = columns[c][i];
        const glm::vec3 colour = store.colour(i);
        node->colour = {colour.r, colour.g, colour.b};
        node->next = nullptr;
        *end_ = node;
        end_ = &node->next;
        ++size_;
    }
}

void LinkedParticles::show(ParticleStore& store) const {
    store.resize(size_);
    const auto columns = columnsOf(store);
    const auto colours = coloursOf(store);
    std::size_t i = 0;
    for (const Node* node = first_; node; node = node->next, ++i) {
        store.serial[i] = node->serial;
        for (std::size_t c = 0; c < columns.size(); ++c) columns[c][i] = node->values[c];
        if (!store.uniformColour)
            for (std::size_t c = 0; c < colours.size(); ++c) colours[c][i] = node->colour[c];
    }
}

}  // namespace dustbench::particles
