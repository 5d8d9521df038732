// The files that a run reads.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/measure/provenance.h"
#include "bench/scene/world.h"
#include "methods/contract/parameters.h"
#include "methods/kit/files/input_log.h"

namespace dustbench::bench {

/// Files of data that a method's parameters name: a fluid, a shape. Throws InputError where one is missing.
[[nodiscard]] std::vector<std::filesystem::path> dataFilesOf(const ParameterValues& parameters);

/// Writes down the world's files, those of the method, and all others that were read, because files name other files,
/// and what was looked for. Throws InputError if a file is missing.
void recordInputs(const World& world, const ParameterValues& ofMethod, const files::InputLog& read,
                  Provenance& provenance);

}  // namespace dustbench::bench
