// The kind of part that emits events, and says what each of them does to a system of the same file.
//
// The events of a step take effect at the beginning of the next one, so that the order of systems in a file does not
// matter. Source: Thesis, 7.3 (particles launched by events, with a script).
#pragma once

#include <span>
#include <vector>

#include "methods/kit/particles/event.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/surface.h"

namespace dustbench::particles {

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
    std::string changes{}, to{};  ///< SYSTEM.KIND.PARAMETER (part_change.h), and its value
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

}  // namespace dustbench::particles
