// Particles born in this step, before they are added to the store.
//
// Units: s. Owns: nothing. Threads: one set, one thread.
#pragma once

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

/// `chunk.age` is the time between birth and the end of the step; `moment` is 0 at the step's begin and 1 at its end.
struct Newborns {
    Chunk chunk;
    const float* moment;
    const Emitter* const*
        emitter;  ///< of each newborn: emitters take turns, so that each gets an equal share, evenly spaced in time
};

}  // namespace dustbench::particles
