// Particles that are born in this step, before they join the others.
//
// Units: s. Owns: nothing. Threads: one set, one thread.
#pragma once

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

/// `chunk.age` is what is left of the step after the birth; `moment` is when, 0 at the step's begin, 1 at its end.
struct Newborns {
    Chunk chunk;
    const float* moment;
    const Emitter* const*
        emitter;  ///< of each newborn: they take turns, so that all get the same share, evenly in time
};

}  // namespace dustbench::particles
