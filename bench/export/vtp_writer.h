// Writes particles as points with serial, age, lifetime, radius, opacity, velocity and, if they differ in it, colour
// and system.
#pragma once

#include <filesystem>
#include <span>

#include "bench/export/vtk_file.h"
#include "methods/contract/volume.h"

namespace dustbench::bench {

/// `systems`: the number of the system of each particle, from 1; empty: all are of one. Written completely or not at
/// all. Throws InputError if it cannot be written.
void writeVtp(const Puffs& dust, const FileOrigin& origin, const std::filesystem::path& file,
              std::span<const int> systems = {});

}  // namespace dustbench::bench
