#include "methods/kit/particles/linked_particles.h"

#include <array>
#include <utility>

namespace dustbench::particles {

struct LinkedParticles::Node {
    std::uint64_t serial;
    std::array<float, 10> values;  ///< in the order of `columnsOf`
    std::array<float, 3> colour;   ///< linear RGB
    Node* next;
};

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
