// The particles of a system in a simply linked list, with or without a pool of dead ones.
//
// Between updates, the nodes hold the particles. Parts and pictures work on columns: after the parts of a step, `bury`
// writes the columns back into the nodes and unlinks the dead, `add` links newborns, and `show` fills the columns from
// the nodes. Each walks the list once.
//
// Owns: the nodes, booked on a ledger. Threads: one at a time; a list can only be walked from its start.
// Source: Thesis, 3.1.3 (linked list) and 3.3.1 (pool). Departs: newborns are linked at the end, so that the order is
// that of birth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "methods/contract/choices.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::particles {

/// How a system keeps its particles between updates.
enum class Storage {
    array,  ///< in the columns; newborns fill the places of the dead
    list,   ///< in nodes that are allocated at birth and freed at death
    pool,   ///< in nodes that are kept after death for newborns
};
inline constexpr Choices<Storage> storages{{"array", Storage::array}, {"list", Storage::list}, {"pool", Storage::pool}};

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
