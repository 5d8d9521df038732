// Particles born in this step, before they are added to the store.
//
// Units: s. Owns: nothing. Threads: one set, one thread.
#pragma once

#include "methods/kit/particles/chunk.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

/// `chunk.age` is the time between birth and the end of the step; `moment` is 0 at the step's start and 1 at its end.
struct Newborns {
    Chunk chunk;
    const float* moment;
    const Emitter* const*
        emitter;  ///< of each newborn: emitters alternate, so that each gets an equal share, evenly spaced

    /// Position of newborn `i`'s emitter at its birth, on its straight path during the step: the centre of the source.
    [[nodiscard]] glm::vec3 centre(std::size_t i) const {
        return glm::mix(emitter[i]->from, emitter[i]->to, moment[i]);
    }
    void setPosition(std::size_t i, const glm::vec3& position) const {
        chunk.x[i] = position.x;
        chunk.y[i] = position.y;
        chunk.z[i] = position.z;
    }
    void setVelocity(std::size_t i, const glm::vec3& velocity) const {
        chunk.velocityX[i] = velocity.x;
        chunk.velocityY[i] = velocity.y;
        chunk.velocityZ[i] = velocity.z;
    }
};

}  // namespace dustbench::particles
