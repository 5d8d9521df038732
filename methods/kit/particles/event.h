// What happens to the particles of a system: a birth, a death, a contact, an entry into a region; or a timer.
//
// Units: m, m/s. Frame: world.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace dustbench::particles {

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

}  // namespace dustbench::particles
