// Records what happens to the particles of a system in a step, as far as its event parts watch it.
//
// Owns: the lists. Threads: chunks and blocks of newborns may be noted by any thread, one each; the rest by one. The
// order of all lists is that of storage and of birth, for any number of threads.
#pragma once

#include <array>

#include "methods/kit/particles/newborns.h"
#include "methods/kit/particles/part_list.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::particles {

class EventRecord {
 public:
    /// Begins a step with `particles`, and lets the parts begin it.
    void begin(const PartList& parts, const Step& step, const ParticleStore& store);
    /// Where chunk `chunk` notes its hits; null: nobody watches them.
    [[nodiscard]] std::vector<Hit>* hitsOfChunk(std::size_t chunk) { return hitsOf(0, chunk); }
    [[nodiscard]] std::span<std::vector<Hit>> hitsOfChunks() { return hits_[0]; }
    /// All particles have moved; those at `dead` die.
    void noteMoved(const ParticleStore& store, std::span<const std::uint32_t> dead, float stepSeconds);

    /// Makes room for further births. Blocks are those of NewbornBlock.
    void beginBirths(std::size_t births, std::size_t blockSize);
    [[nodiscard]] std::vector<Hit>* hitsOfBlock(std::size_t block) { return hitsOf(1, blocksBefore_ + block); }
    /// Newborns from `first` on of those that `beginBirths` announced.
    void noteBirths(std::size_t first, const Newborns& newborns);

    /// Ends the step: the events of each event part.
    void end(const PartList& parts, double stepSeconds);
    [[nodiscard]] std::span<const std::vector<Event>> events() const { return events_; }

 private:
    [[nodiscard]] bool watches(Watched what) const { return watched_[static_cast<std::size_t>(what)]; }
    [[nodiscard]] std::vector<Hit>* hitsOf(std::size_t of, std::size_t list) {
        return watches(Watched::hits) ? &hits_[of][list] : nullptr;
    }

    std::array<bool, 5> watched_{};
    std::array<std::vector<std::vector<Hit>>, 2> hits_;  ///< by chunk; by block of newborns
    std::vector<Event> births_, deaths_, moved_;
    std::array<std::vector<float>, 7> ways_;  ///< from x, y, z, to x, y, z, seconds
    std::size_t birthsBefore_ = 0, blocksBefore_ = 0, waysBefore_ = 0;
    double seconds_ = 0;  ///< since the first step
    std::vector<std::vector<Event>> events_;
};

}  // namespace dustbench::particles
