// The particles of one system as a structure of arrays.
//
// Units: m, m/s, s. Frame: world. Owns: its columns, booked on a ledger. Colours: linear RGB, already lit.
// Threads: any thread may call const members; one writer, or several on disjoint ranges of particles.
// Source: Thesis, 3.1.2 (the attributes of a particle). Departs: acceleration and luminosity exist only during an
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
    /// Bytes of all columns, including the colour.
    static constexpr std::size_t bytesPerParticle = sizeof(std::uint64_t) + 13 * sizeof(float);

    explicit ParticleStore(MemoryLedger& ledger);

    [[nodiscard]] std::size_t size() const { return serial.size(); }
    [[nodiscard]] bool empty() const { return serial.empty(); }
    void reserve(std::size_t count);
    /// Grows the capacity by at least a quarter if it is exceeded, so that allocated memory stays close to used memory.
    void resize(std::size_t count);
    /// Copies all columns of particle `from` over particle `to`.
    void move(std::size_t from, std::size_t to);
    /// `count` particles from `first` on, for the parts; without scratch pointers.
    [[nodiscard]] Chunk chunk(std::size_t first, std::size_t count);
    /// Copies particle `from` of a chunk over particle `to`; colour only if colours are kept.
    void put(const Chunk& chunk, std::size_t from, std::size_t to);
    /// Appends copies; colours become one per particle unless all have the same.
    void append(const Puffs& puffs);
    /// Hash of every column, in storage order.
    [[nodiscard]] std::uint64_t hash() const;
    /// Stores one colour for all particles, or one per particle, initialised to `colourOfAll`.
    void keepOneColour(bool oneForAll);

    /// The view for methods and metrics: the same columns, valid until the store changes.
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

    bool uniformColour = true;  ///< one colour for all: no colour columns
    glm::vec3 colourOfAll{1};

 private:
    template <typename Action>
    void forEachColumn(Action action);
};

}  // namespace dustbench::particles
