#include "methods/kit/particles/events.h"

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/particles/part_list.h"
#include "methods/kit/particles/particle_store.h"

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

Event eventOf(const ParticleStore& s, std::size_t i) {
    return {s.position(i), {s.velocityX[i], s.velocityY[i], s.velocityZ[i]}, {0, 1, 0}, s.serial[i]};
}

Event eventOf(const Chunk& c, std::size_t i) {
    return {{c.x[i], c.y[i], c.z[i]}, {c.velocityX[i], c.velocityY[i], c.velocityZ[i]}, {0, 1, 0}, c.serial[i]};
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

void EventRecord::begin(const PartList& parts, const Step& step, const ParticleStore& store) {
    watched_ = {};
    for (const auto& part : parts.events()) {
        watched_[static_cast<std::size_t>(part->watches())] = true;
        part->begin(step);
    }
    for (auto* list : {&births_, &deaths_, &moved_}) list->clear();
    for (auto& lists : hits_) lists.clear();
    for (auto& column : ways_) column.clear();
    birthsBefore_ = blocksBefore_ = waysBefore_ = 0;
    if (watches(Watched::hits)) hits_[0].resize((store.size() + chunkSize - 1) / chunkSize);
    if (!watches(Watched::ways)) return;
    ways_[0].assign(store.x.begin(), store.x.end());
    ways_[1].assign(store.y.begin(), store.y.end());
    ways_[2].assign(store.z.begin(), store.z.end());
}

void EventRecord::noteMoved(const ParticleStore& store, std::span<const std::uint32_t> dead, float stepSeconds) {
    if (watches(Watched::deaths))
        for (const std::uint32_t i : dead) deaths_.push_back(eventOf(store, i));
    if (!watches(Watched::ways)) return;
    ways_[3].assign(store.x.begin(), store.x.end());
    ways_[4].assign(store.y.begin(), store.y.end());
    ways_[5].assign(store.z.begin(), store.z.end());
    ways_[6].assign(store.size(), stepSeconds);
    moved_.reserve(store.size());
    for (std::size_t i = 0; i < store.size(); ++i) moved_.push_back(eventOf(store, i));
}

void EventRecord::beginBirths(std::size_t births, std::size_t blockSize) {
    birthsBefore_ = births_.size();
    blocksBefore_ = hits_[1].size();
    waysBefore_ = moved_.size();
    if (watches(Watched::births)) births_.resize(birthsBefore_ + births);
    if (watches(Watched::hits)) hits_[1].resize(blocksBefore_ + (births + blockSize - 1) / blockSize);
    if (!watches(Watched::ways)) return;
    moved_.resize(waysBefore_ + births);
    for (auto& column : ways_) column.resize(waysBefore_ + births);
}

void EventRecord::noteBirths(std::size_t first, const Newborns& newborns) {
    const Chunk& c = newborns.chunk;
    if (watches(Watched::births))
        for (std::size_t i = 0; i < c.count; ++i) births_[birthsBefore_ + first + i] = eventOf(c, i);
    if (!watches(Watched::ways)) return;
    for (std::size_t i = 0; i < c.count; ++i) {
        const std::size_t way = waysBefore_ + first + i;
        const Event event = eventOf(c, i);
        const glm::vec3 from = event.place - c.age[i] * event.velocity;
        moved_[way] = event;
        for (int axis = 0; axis < 3; ++axis) {
            const auto column = static_cast<std::size_t>(axis);
            ways_[column][way] = from[axis];
            ways_[column + 3][way] = event.place[axis];
        }
        ways_[6][way] = c.age[i];
    }
}

void EventRecord::end(const PartList& parts, double stepSeconds) {
    std::vector<Hit> hits;
    for (const auto& lists : hits_)
        for (const auto& list : lists) hits.insert(hits.end(), list.begin(), list.end());
    const auto& w = ways_;
    const Happened happened{
        seconds_,
        seconds_ + stepSeconds,
        births_,
        deaths_,
        hits,
        {moved_.size(), w[0].data(), w[1].data(), w[2].data(), w[3].data(), w[4].data(), w[5].data(), w[6].data()},
        moved_};
    events_.resize(parts.events().size());
    for (std::size_t k = 0; k < events_.size(); ++k) {
        events_[k].clear();
        parts.events()[k]->find(happened, events_[k]);
    }
    seconds_ += stepSeconds;
}

}  // namespace dustbench::particles
