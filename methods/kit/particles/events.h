// What happens to the particles of a system: a birth, a death, a contact, an entry into a region; or a timer. The
// record of a step, and the kind of part that finds events in it and says what each does to a system of the same file.
//
// The events of a step take effect at the beginning of the next one (event_script.h), so that the order of systems in a
// file does not matter. Units: m, m/s, s. Frame: world. Source: Thesis, 7.3 (particles launched by events, with a
// script).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/contacts.h"
#include "methods/kit/particles/part.h"

namespace dustbench::particles {

class ParticleStore;
class PartList;

struct Event {
    glm::vec3 place{0};
    glm::vec3 velocity{0};     ///< of the particle, before a contact; 0 for a timer
    glm::vec3 up{0, 1, 0};     ///< of a contact: the surface's normal, unit
    std::uint64_t serial = 0;  ///< of the particle; of a timer: number of times it rang before
};

/// A contact with a surface.
struct Hit {
    Event event;
    int surface;  ///< its number among the surfaces of the system, from 1: those of forces, then of lives
    float speed;  ///< into the surface, relative to it
};

/// What a part wants to know of a step. Only what a part of the system watches is recorded.
enum class Watched { births, deaths, hits, ways, time };

/// What happened to the particles of a system in a step, in an order that does not depend on threads.
struct Happened {
    double beginSeconds, endSeconds;  ///< of the step, since the system's first one
    std::span<const Event> births;    ///< place at the end of the step
    std::span<const Event> deaths;    ///< likewise
    std::span<const Hit> hits;
    Ways ways;                     ///< straight, from the start of the step or from birth, to its end
    std::span<const Event> moved;  ///< the particle of each way, at its end
};

/// What an event does. Systems are named; an empty name: nothing.
struct EventAction {
    std::string starts{};  ///< system in which `count` particles are born
    std::int64_t count = 1;
    bool atEvent = true;  ///< at the place of the event; false: at the system's own source
    float inherit = 0;    ///< share of the event's velocity, added to that of newborns
    std::string stops{}, resumes{};
    std::string changes{}, to{};  ///< SYSTEM.KIND.PARAMETER (part_list.h), and its value
    float share = 1;              ///< of events that act, chosen by chance
    std::int64_t limit = 0;       ///< number of events that act; 0: all
};

class DUSTBENCH_API EventPart : public Part {
 public:
    /// Throws InputError if a change lacks its value, or the event does nothing.
    explicit EventPart(const ParameterValues& values);
    ~EventPart() override;
    [[nodiscard]] PartKind kind() const final { return PartKind::event; }

    [[nodiscard]] const EventAction& action() const { return action_; }
    [[nodiscard]] virtual Watched watches() const = 0;
    /// Called once per step before all chunks.
    virtual void begin(const Step&) {}
    /// Appends the events of a step.
    virtual void find(const Happened& happened, std::vector<Event>& events) const = 0;

    /// Of `events`, how many may act until the limit is reached; counts them.
    [[nodiscard]] std::size_t admit(std::size_t events);
    void takeOver(const Part& before) final;

    /// Declares what EventAction contains.
    static void declareAction(ParameterSet& set);

 private:
    EventAction action_;
    std::int64_t acted_ = 0;
};

/// Records what happens to the particles of a system in a step, as far as its event parts watch it.
/// Threads: chunks and blocks of newborns may be noted by any thread, one each; the rest by one. The order of all lists
/// is that of storage and of birth, for any number of threads.
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
