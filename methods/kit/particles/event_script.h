// Carries the events of several systems to the systems that they name: starts particles, stops or resumes emissions,
// changes parts.
//
// Threads: one. Events are applied in the order of systems, of their event parts, and of the particles' storage, so
// that results do not depend on the number of threads.
#pragma once

#include <span>
#include <string>

#include "methods/kit/particles/part_toml.h"
#include "methods/kit/particles/particle_system.h"

namespace dustbench::particles {

struct ScriptedSystem {
    std::string name;
    ParticleSystem& particles;
};

/// Throws InputError if an event names a system that does not exist, or a change that is impossible at the beginning.
DUSTBENCH_API void requireScript(std::span<const NamedPartsView> systems);

/// Applies the events of the last update. Returns true if a part has changed. Throws as above.
DUSTBENCH_API bool applyEvents(std::span<const ScriptedSystem> systems);

}  // namespace dustbench::particles
