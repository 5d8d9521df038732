#include "methods/kit/particles/event_part.h"

#include <algorithm>

#include "methods/contract/errors.h"

namespace dustbench::particles {
namespace {

enum class EventBirthplace { event, source };
constexpr Choices<EventBirthplace> eventBirthplaces{{"event", EventBirthplace::event},
                                                    {"source", EventBirthplace::source}};

EventAction actionOf(const ParameterValues& values) {
    return {values.choice("starts"),
            values.integer("count"),
            values.choice("at", eventBirthplaces) == EventBirthplace::event,
            static_cast<float>(values.real("inherit")),
            values.choice("stops"),
            values.choice("resumes"),
            values.choice("changes"),
            values.choice("to"),
            static_cast<float>(values.real("share")),
            values.integer("limit")};
}

}  // namespace

EventPart::EventPart(const ParameterValues& values) : Part(values), action_(actionOf(values)) {
    if (action_.changes.empty() != action_.to.empty())
        throw InputError("parameter " + std::string(action_.changes.empty() ? "to" : "changes") +
                         ": got it alone, allowed: changes and to together");
}

EventPart::~EventPart() = default;

std::size_t EventPart::admit(std::size_t events) {
    if (action_.limit > 0)
        events = std::min(events, static_cast<std::size_t>(std::max(action_.limit - acted_, std::int64_t{0})));
    acted_ += static_cast<std::int64_t>(events);
    return events;
}

void EventPart::takeOver(const Part& before) {
    acted_ = static_cast<const EventPart&>(before).acted_;
}

void EventPart::declareAction(ParameterSet& set) {
    set.choice("starts", "", {}, "system in which each event makes particles; empty: none")
        .integer("count", 1, 1, 1'000'000, "", "particles that each event makes")
        .choice("at", EventBirthplace::event, eventBirthplaces,
                "they are born at the event, whose surface is the source's ground, or at their system's own source")
        .real("inherit", 0, -10, 10, "", "share of the velocity of the particle that they have in addition")
        .choice("stops", "", {}, "system whose emission pauses")
        .choice("resumes", "", {}, "system whose emission continues")
        .choice("changes", "", {}, "parameter or part that changes, as for --at: SYSTEM.velocity.speed")
        .choice("to", "", {}, "its value; place or velocity: that of the event, for a vector")
        .real("share", 1, 0, 1, "", "share of the events that act, chosen by chance")
        .integer("limit", 0, 0, 1'000'000'000, "", "number of events that act, the first ones; 0: all");
}

}  // namespace dustbench::particles
