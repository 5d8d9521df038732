// The files that a run reads.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/measure/provenance.h"
#include "bench/world/world.h"
#include "methods/contract/parameters.h"
#include "methods/kit/files/input_log.h"

namespace dustbench::results {

/// Data files that a method's parameters name, such as a fluid or a shape. Throws InputError if one is missing.
[[nodiscard]] std::vector<std::filesystem::path> dataFilesOf(const ParameterValues& parameters);

/// Records the files of the world and the method, the further files that these name, and the searches for files. Throws
/// InputError if a file is missing.
void recordInputs(const world::World& world, const ParameterValues& ofMethod, const files::InputLog& read,
                  measure::Provenance& provenance);

}  // namespace dustbench::results
