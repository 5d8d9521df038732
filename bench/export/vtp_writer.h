// Writes particles as points with serial, age, lifetime, radius, opacity, velocity and, where each has its own, colour.
#pragma once

#include <filesystem>
#include "methods/contract/volume.h"

namespace dustbench::bench {

/// Whole or not at all. Throws InputError where it cannot be written.
void writeVtp(const Puffs& dust, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::bench
