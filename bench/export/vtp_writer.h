// Writes particles as points with serial, age, lifetime, radius, opacity, velocity and, if they differ in it, colour.
#pragma once

#include <filesystem>
#include "methods/contract/volume.h"

namespace dustbench::bench {

/// Written completely or not at all. Throws InputError if it cannot be written.
void writeVtp(const Puffs& dust, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::bench
