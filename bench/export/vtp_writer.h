// Writes particles as points with serial, age, lifetime, radius, opacity, velocity and, where each has its own, colour.
#pragma once

#include <filesystem>

namespace dustbench::particles {
class ParticleStore;
}

namespace dustbench::bench {

/// Whole or not at all. Throws InputError where it cannot be written.
void writeVtp(const particles::ParticleStore& dust, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::bench
