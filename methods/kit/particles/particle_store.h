// The particles of one system: as a structure of arrays, which parts and pictures work on, and, if the system chooses
// so, between updates in a simply linked list, with or without a pool of dead ones.
//
// Units: m, m/s, s. Frame: world. Owns: columns and nodes, booked on a ledger. Colours: linear RGB, already lit.
// Threads: any thread may call const members of the store; one writer, or several on disjoint ranges of particles. A
// list can only be walked from its start, by one. Source: Thesis, 3.1.2 (the attributes of a particle), 3.1.3 (linked
// list) and 3.3.1 (pool). Departs: acceleration and luminosity exist only during an update; newborns are linked at the
// end of a list, so that the order is that of birth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/contract/choices.h"
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

/// How a system keeps its particles between updates.
enum class Storage {
    array,  ///< in the columns; newborns fill the places of the dead
    list,   ///< in nodes that are allocated at birth and freed at death
    pool,   ///< in nodes that are kept after death for newborns
};
inline constexpr Choices<Storage> storages{{"array", Storage::array}, {"list", Storage::list}, {"pool", Storage::pool}};

/// Between updates, the nodes hold the particles. After the parts of a step, `bury` writes the columns back into the
/// nodes and unlinks the dead, `add` links newborns, and `show` fills the columns from the nodes. Each walks the list
/// once.
class LinkedParticles {
 public:
    /// `pool`: keeps the nodes of the dead. The ledger must outlive it.
    LinkedParticles(MemoryLedger& ledger, bool pool);
    ~LinkedParticles();
    LinkedParticles(const LinkedParticles&) = delete;
    LinkedParticles& operator=(const LinkedParticles&) = delete;

    [[nodiscard]] bool pool() const { return pool_; }
    /// Writes the columns into the nodes, which are in the same order, except for the `dead` (ascending indices), whose
    /// nodes go to the pool or are freed.
    void bury(const ParticleStore& store, std::span<const std::uint32_t> dead);
    /// Links copies of the particles from `first` on at the end.
    void add(const ParticleStore& store, std::size_t first);
    /// Makes the store equal to the list.
    void show(ParticleStore& store) const;

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Number of nodes allocated since the beginning.
    [[nodiscard]] std::uint64_t allocations() const { return allocations_; }
    static std::size_t bytesPerParticle();

 private:
    struct Node;

    [[nodiscard]] Node* take();

    MemoryAccount& account_;
    bool pool_;
    Node* first_ = nullptr;
    Node** end_ = &first_;  ///< the link behind the last node
    Node* dead_ = nullptr;  ///< the pool
    std::size_t size_ = 0;
    std::uint64_t allocations_ = 0;
};

}  // namespace dustbench::particles
