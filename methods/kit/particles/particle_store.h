// The particles of one system as a structure of arrays.
//
// Units: m, m/s, s. Frame: world. Owns: its columns, booked on a ledger. Colours: linear RGB, as seen (already lit).
// Threads: const access from any; one writer, or several on disjoint ranges of particles.
// Source: Thesis, 3.1.2 (the attributes of a particle). Departs: acceleration and luminosity live only during an
// update.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "methods/contract/volume.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::particles {

class DUSTBENCH_API ParticleStore {
 public:
    explicit ParticleStore(MemoryLedger& ledger);

    [[nodiscard]] std::size_t size() const { return serial.size(); }
    [[nodiscard]] bool empty() const { return serial.empty(); }
    void reserve(std::size_t count);
    /// Grows by a quarter where there is no room: the memory held stays near what is used.
    void resize(std::size_t count);
    /// Moves particle `from` over particle `to` (all columns).
    void move(std::size_t from, std::size_t to);
    /// `count` particles from `first` on, for the parts to work on; without scratch.
    [[nodiscard]] Chunk chunk(std::size_t first, std::size_t count);
    /// Copies particle `from` of a chunk (its colour, where colours are kept) over particle `to`.
    void put(const Chunk& chunk, std::size_t from, std::size_t to);
    /// Of every column, in storage order.
    [[nodiscard]] std::uint64_t hash() const;
    /// Keeps a colour for each particle, at first `colourOfAll`, or one for all.
    void keepOneColour(bool oneForAll);

    /// What methods and metrics see: the same columns, valid until the store changes.
    [[nodiscard]] operator Puffs() const;  // NOLINT(google-explicit-constructor): a store is seen as its puffs anywhere

    [[nodiscard]] glm::vec3 position(std::size_t i) const { return {x[i], y[i], z[i]}; }
    [[nodiscard]] glm::vec3 colour(std::size_t i) const {
        return uniformColour ? colourOfAll : glm::vec3{red[i], green[i], blue[i]};
    }

    LedgerVector<std::uint64_t> serial;  ///< unique within the system, in order of birth
    LedgerVector<float> x, y, z;
    LedgerVector<float> velocityX, velocityY, velocityZ;
    LedgerVector<float> age, lifetime;
    LedgerVector<float> radius;
    LedgerVector<float> opacity;           ///< peak opacity α, 0..0.999
    LedgerVector<float> red, green, blue;  ///< empty while `uniformColour`

    bool uniformColour = true;  ///< one colour for all: then no colour columns are kept
    glm::vec3 colourOfAll{1};

 private:
    template <typename Action>
    void forEachColumn(Action action);
};

}  // namespace dustbench::particles
