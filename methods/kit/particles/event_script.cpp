#include "methods/kit/particles/event_script.h"

#include <fmt/format.h>

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {
namespace {

/// The events of one part that act.
struct ScriptedEvents {
    EventAction action;
    std::vector<Event> events;
};

/// Two directions that complete `up` to the axes of a source.
Emitter emitterAt(const Event& event, float inherit) {
    Emitter emitter;
    emitter.from = emitter.to = event.place;
    emitter.thrown = inherit * event.velocity;
    if (event.up == emitter.up) return emitter;
    const glm::vec3 aside = std::abs(event.up.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    emitter.up = event.up;
    emitter.right = glm::normalize(glm::cross(aside, event.up));
    emitter.forward = glm::cross(event.up, emitter.right);
    return emitter;
}

std::vector<std::string> namesOf(const auto& systems) {
    std::vector<std::string> names;
    for (const auto& system : systems) names.push_back(system.name);
    return names;
}

std::size_t indexOf(const std::vector<std::string>& names, std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw unknownName("particle system", name, names);
    return static_cast<std::size_t>(found - names.begin());
}

/// Removes the system's name from the beginning of a change.
std::size_t cutSystem(const std::vector<std::string>& names, std::string_view& change) {
    const std::string_view name = change.substr(0, change.find('.'));
    const std::size_t index = indexOf(names, name);
    change.remove_prefix(std::min(name.size() + 1, change.size()));
    return index;
}

void changeBy(PartList& parts, std::string_view name, const std::string& to, const Event& event) {
    if (to != "place" && to != "velocity") return changePart(parts, name, to);
    const glm::vec3& vector = to == "place" ? event.place : event.velocity;
    constexpr std::array<const char*, 3> axes{".x", ".y", ".z"};
    for (int axis = 0; axis < 3; ++axis)
        changePart(parts, std::string(name) + axes[static_cast<std::size_t>(axis)], fmt::format("{}", vector[axis]));
}

/// The events of a system that act: the script's chance and limits.
void collectActing(ParticleSystem& system, std::vector<ScriptedEvents>& acting) {
    const auto all = system.events();
    const auto& parts = system.parts().events();
    for (std::uint32_t k = 0; k < std::min(all.size(), parts.size()); ++k) {
        const EventAction& action = parts[k]->action();
        ScriptedEvents chosen{action, {}};
        for (const Event& event : all[k])
            if (action.share >= 1 || system.chanceOf(event.serial, k) < action.share) chosen.events.push_back(event);
        chosen.events.resize(parts[k]->admit(chosen.events.size()));
        if (!chosen.events.empty()) acting.push_back(std::move(chosen));
    }
}

}  // namespace

void requireScript(std::span<const NamedPartsView> systems) {
    const std::vector<std::string> names = namesOf(systems);
    for (const NamedPartsView& system : systems)
        for (const auto& part : system.parts.events()) {
            const EventAction& action = part->action();
            try {
                for (const std::string* name : {&action.starts, &action.stops, &action.resumes})
                    if (!name->empty()) (void)indexOf(names, *name);
                if (action.changes.empty()) continue;
                std::string_view change = action.changes;
                const std::size_t target = cutSystem(names, change);
                const NamedPartsView view{names[target], systems[target].parts};
                const auto copy = systemsFromText(systemsToToml({&view, 1}), view.name);
                changeBy(*copy.front().parts, change, action.to, {});
            } catch (const InputError& error) {
                throw InputError("event " + part->name() + " of system " + system.name + ": " + error.what());
            }
        }
}

bool applyEvents(std::span<const ScriptedSystem> systems) {
    std::vector<ScriptedEvents> acting;
    for (const ScriptedSystem& system : systems) collectActing(system.particles, acting);
    if (acting.empty()) return false;
    const std::vector<std::string> names = namesOf(systems);
    const auto systemNamed = [&](const std::string& name) -> ParticleSystem& {
        return systems[indexOf(names, name)].particles;
    };
    bool changed = false;
    for (const auto& [action, events] : acting) {
        if (!action.starts.empty()) {
            std::vector<Emitter> emitters;
            if (action.atEvent)
                for (const Event& event : events) emitters.push_back(emitterAt(event, action.inherit));
            systemNamed(action.starts)
                .start(action.count * static_cast<std::int64_t>(events.size()), std::move(emitters));
        }
        if (!action.stops.empty()) systemNamed(action.stops).emit(false);
        if (!action.resumes.empty()) systemNamed(action.resumes).emit(true);
        if (action.changes.empty()) continue;
        std::string_view change = action.changes;
        const std::size_t target = cutSystem(names, change);
        changeBy(systems[target].particles.parts(), change, action.to, events.back());
        changed = true;
    }
    return changed;
}

}  // namespace dustbench::particles
